// The live view of a scene file, served by a separate thread.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <atomic>
#include <future>
#include <memory>
#include <thread>

#include "command/viewed_file.hpp"
#include "module.hpp"
#include "output/error.hpp"
#include "render/threads.hpp"
#include "view/server.hpp"

namespace py = pybind11;

namespace phasetree::python {

namespace {

using namespace phasetree::tracer;

class View {
  public:
    // Returns once the page is served. Throws what reading the scene throws, and std::runtime_error if no port is
    // available.
    View(const std::string& file, std::optional<int> width, std::optional<int> samples, int threads, int port)
        : file_{{file, std::nullopt, std::nullopt}, std::nullopt, std::nullopt} {
        view::require_server();
        document_ = file_.document(true);
        const view::ReadScene read = file_.reader(*document_);
        if (const auto state = document_->state(); state->error) throw *state->error;
        std::promise<std::string> served;
        std::future<std::string> url = served.get_future();
        serving_ = std::thread([=, this, served = std::move(served)]() mutable {
            try {
                serve(read, width, samples, threads, port, served);
            } catch (...) {
                served.set_exception(std::current_exception());
            }
        });
        try {
            url_ = url.get();
        } catch (...) {
            serving_.join();
            throw;
        }
    }
    ~View() { close(); }
    View(const View&) = delete;
    View& operator=(const View&) = delete;

    const std::string& url() const { return url_; }
    void close() {
        is_over_ = true;
        if (serving_.joinable()) serving_.join();
    }

  private:
    // Binds the port and sets `served` before anything else can throw.
    void serve(const view::ReadScene& read, std::optional<int> width, std::optional<int> samples, int threads, int port,
               std::promise<std::string>& served) {
        const AvailableThreads available(threads);
        view::Session session(
            read, {.name = file_.scene.name,
                   .threads = available.count(),
                   .samples = samples,
                   .width = width,
                   .write_camera = [this](const std::string& camera) { write_camera(*document_, camera); },
                   .write_numbers = [this](const view::NumberEdits& numbers) { write_numbers(*document_, numbers); }});
        document_->on_change([&] { session.text_changed(); });
        view::serve(session, {.document = document_.get(),
                              .port = port,
                              .may_be_framed = true,
                              .is_over = [this] { return is_over_.load(); },
                              .serving = [&](const std::string& url) { served.set_value(url); }});
    }

    ViewedFile file_;
    std::unique_ptr<studio::EditedDocument> document_;
    std::atomic<bool> is_over_ = false;
    std::string url_;
    std::thread serving_;
};

}  // namespace

void add_viewing(py::module_& module) {
    py::class_<View>(module, "View")
        .def(py::init<const std::string&, std::optional<int>, std::optional<int>, int, int>(), py::arg("file"),
             py::arg("width"), py::arg("samples"), py::arg("threads"), py::arg("port"),
             py::call_guard<py::gil_scoped_release>())
        .def_property_readonly("url", &View::url)
        .def("close", &View::close, py::call_guard<py::gil_scoped_release>());
}

}  // namespace phasetree::python
