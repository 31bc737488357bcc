#include "api/errors.hpp"

#include <new>

#include "embree_core/error.hpp"
#include "phasetree/cells/cells.hpp"
#include "phasetree/cells/file.hpp"
#include "phasetree/io/error.hpp"

namespace phasetree::embree::api {

namespace {

std::string& message() {
    thread_local std::string text;
    return text;
}

PhasetreeError code_of(const EmbreeError& e) {
    switch (e.code()) {
        case RTC_ERROR_CANCELLED:
            return PHASETREE_ERROR_CANCELLED;
        case RTC_ERROR_OUT_OF_MEMORY:
            return PHASETREE_ERROR_OUT_OF_MEMORY;
        default:
            return PHASETREE_ERROR_EMBREE;
    }
}

}  // namespace

void require_version(unsigned api_version) {
    if (api_version == PHASETREE_API_VERSION) return;
    const unsigned number = api_version / 100, embree = api_version % 100;
    if (number == PHASETREE_API_NUMBER && (embree == 3 || embree == 4))
        throw ApiError(PHASETREE_ERROR_VERSION,
                       fmt::format("the application was compiled for Embree {}, but is linked with the library for "
                                   "Embree {}: link phasetree_embree{}",
                                   embree, RTC_VERSION_MAJOR, embree));
    throw ApiError(PHASETREE_ERROR_VERSION,
                   fmt::format("apiVersion is {}, but this library serves {}: pass PHASETREE_API_VERSION, and compile "
                               "with the header that belongs to the library",
                               api_version, PHASETREE_API_VERSION));
}

PhasetreeError report_exception(const char* call) noexcept {
    const auto report = [&](PhasetreeError code, const char* what) noexcept {
        try {
            message() = fmt::format("{}: {}", call, what);
        } catch (...) {
            message().clear();
        }
        return code;
    };
    try {
        throw;
    } catch (const ApiError& e) {
        return report(e.code(), e.what());
    } catch (const EmbreeError& e) {
        return report(code_of(e), e.what());
    } catch (const SceneError& e) {
        return report(PHASETREE_ERROR_INVALID_TREE, e.what());
    } catch (const ModelError& e) {
        return report(PHASETREE_ERROR_INVALID_TREE, e.what());
    } catch (const CellsFileError& e) {
        return report(PHASETREE_ERROR_CELLS_FILE, e.what());
    } catch (const BuildCancelled&) {
        return report(PHASETREE_ERROR_CANCELLED, "cancelled by the application");
    } catch (const std::bad_alloc&) {
        return report(PHASETREE_ERROR_OUT_OF_MEMORY, "not enough memory");
    } catch (const std::exception& e) {
        return report(PHASETREE_ERROR_UNKNOWN, e.what());
    } catch (...) {
        return report(PHASETREE_ERROR_UNKNOWN, "an unknown error");
    }
}

}  // namespace phasetree::embree::api

using namespace phasetree::embree::api;

unsigned int phasetreeGetApiVersion(void) {
    return PHASETREE_API_VERSION;
}

const char* phasetreeGetErrorMessage(void) {
    return message().c_str();
}
