// The C99 interface, called in any order with any arguments. An input is a list of calls: a byte chooses one, the next
// bytes its arguments. Handles are retained and released as they like, freed ones and NULL are passed on purpose, and
// geometries outlive and are outlived by scenes. What the headers leave to the application is kept: a scene is traced
// only as it was committed, and a query has the context that its geometries were promised.
#include <cstring>

#include "fuzz/calls/calls.hpp"

namespace phasetree::fuzz {

void check(PhasetreeError error) {
    promised(error >= PHASETREE_ERROR_NONE && error <= PHASETREE_ERROR_EMBREE, "an error has a code that says which");
    const char* const message = phasetreeGetErrorMessage();
    promised(message != nullptr, "there is a message");
    if (error == PHASETREE_ERROR_NONE) return;
    const std::size_t length = std::strlen(message);
    promised(length > 0 && message[length - 1] != '\n', "an error has a message without a newline at its end");
}

Calls::Calls(Bytes input) : c_(input) {
    static RTCDevice device = rtcNewDevice("threads=1,set_affinity=0");
    device_ = device;
    for (Stage& s : stages_) s.scene = rtcNewScene(device_);
}
Calls::~Calls() {
    for (Stage& s : stages_) rtcReleaseScene(s.scene);
    for (Made& g : geometries_) {
        for (; g.references > 0; --g.references)
            promised(phasetreeReleaseGeometry(g.handle) == PHASETREE_ERROR_NONE, "a live handle is released");
        rtcReleaseGeometry(g.embree);
    }
    for (auto& t : trees_)
        for (; t.references > 0; --t.references)
            promised(phasetreeReleaseTree(t.handle) == PHASETREE_ERROR_NONE, "a live handle is released");
}

void Calls::run() {
    using Call = void (Calls::*)();
    static constexpr Call calls[] = {
        &Calls::new_tree,       &Calls::new_edited_tree,
        &Calls::count_tree,     &Calls::ask_tree,
        &Calls::new_geometry,   &Calls::new_geometry,
        &Calls::count_geometry, &Calls::ask_geometry,
        &Calls::attach,         &Calls::detach,
        &Calls::commit,         &Calls::edit,
        &Calls::show,           &Calls::move,
        &Calls::filter,         &Calls::trace_one,
        &Calls::trace_packet,   &Calls::ask_point,
        &Calls::make_mesh,      &Calls::query_scene,
        &Calls::call_back,      &Calls::instance,
    };
    for (int i = 0; i < 40 && !c_.is_over(); ++i) (this->*c_.of(calls))();
}

void run_calls(Bytes input) {
    Calls(input).run();
}

}  // namespace phasetree::fuzz
