// The calls that an input of the target `calls` may make, by topic: each file in this folder has some.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "fuzz/calls/choices.hpp"
#include "fuzz/target.hpp"
#include "phasetree/phasetree_embree.h"

namespace phasetree::fuzz {

// Checks what every call guarantees about its error.
void check(PhasetreeError);
// A filter that lets no crossing into phase 1 pass.
void reject_some(const RTCFilterFunctionNArguments*);

template <class Handle>
struct Counted {
    Handle handle{};
    int references = 0;
};
struct Made : Counted<PhasetreeGeometry> {
    RTCGeometry embree = nullptr;  // retained
    bool may_filter = true;
};
struct Stage {
    RTCScene scene = nullptr;
    std::vector<std::pair<unsigned, std::size_t>> attached;  // geomID, place in the list of geometries
    bool is_committed = false;
};

struct QueryContext;

class Calls {
  public:
    explicit Calls(Bytes input);
    ~Calls();
    Calls(const Calls&) = delete;
    Calls& operator=(const Calls&) = delete;

    void run();

  private:
    unsigned version() { return c_.rarely() ? c_.byte() : PHASETREE_API_VERSION; }

    PhasetreeTree tree() {
        if (c_.rarely() || trees_.empty()) return reinterpret_cast<PhasetreeTree>(std::uintptr_t{c_.byte()} << 44 | 1);
        return trees_[c_.below(static_cast<unsigned>(trees_.size()))].handle;
    }
    PhasetreeGeometry geometry() {
        if (c_.rarely() || geometries_.empty()) return reinterpret_cast<PhasetreeGeometry>(std::uintptr_t{c_.byte()});
        return geometries_[c_.below(static_cast<unsigned>(geometries_.size()))].handle;
    }
    template <class List, class Handle>
    bool is_live(const List& list, Handle handle) const {
        for (const auto& one : list)
            if (one.handle == handle && one.references > 0) return true;
        return false;
    }
    bool is_live(PhasetreeTree handle) const { return is_live(trees_, handle); }
    bool is_live(PhasetreeGeometry handle) const { return is_live(geometries_, handle); }
    // A call with this handle: no other is served.
    template <class Handle>
    void check_with(Handle handle, PhasetreeError error) {
        check(error);
        if (!is_live(handle)) promised(error != PHASETREE_ERROR_NONE, "a handle that is not live is rejected");
    }
    // Counts a reference more or less of a handle, live or not.
    template <class List, class Handle>
    void count(List& list, Handle handle, PhasetreeError error, int by) {
        check_with(handle, error);
        for (auto& one : list)
            if (one.handle == handle && one.references > 0) {
                promised(error == PHASETREE_ERROR_NONE, "a live handle is served");
                one.references += by;
                return;
            }
    }

    // trees.cpp
    void new_tree();
    void new_edited_tree();
    void count_tree();
    void ask_tree();
    void ask_tree_precisely(PhasetreeTree);
    void measure_tree(PhasetreeTree);

    // geometries.cpp
    PhasetreeGeometryOptions options();
    void new_geometry();
    void count_geometry();
    void ask_geometry();
    void edit();
    void show();
    void move();
    void filter();
    // Handles that are not live have empty bounds.
    void call_back();

    // scenes.cpp
    Stage& stage() { return stages_[c_.below(2)]; }
    void change();
    void attach();
    void detach();
    // The inner scene first: the outer one may have an instance of it.
    void commit();
    void instance();

    // queries.cpp
    // Numbers that Embree takes: Debian's ends the process with an assertion at others.
    float finite();
    RTCRay ray();
    void prepare(QueryContext&);
    void trace_one();
    void trace_packet();
    void ask_point();
    void make_mesh();
    void query_scene();

    Choices c_;
    RTCDevice device_ = nullptr;
    std::vector<Counted<PhasetreeTree>> trees_;
    std::vector<Made> geometries_;
    Stage stages_[2];
    unsigned questions_ = 0;
    bool has_instance_ = false, point_query_ = false;
};

}  // namespace phasetree::fuzz
