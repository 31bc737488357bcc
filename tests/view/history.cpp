// Steps of undo and redo.
#include "studio/history.hpp"

#include <doctest/doctest.h>

namespace test_history {

using phasetree::tracer::studio::History;

TEST_CASE("steps with the same key are one step, and a drag that ends where it began is none") {
    History history("r = 1");
    history.add("r = 2", "first");
    for (const char* const text : {"r = 3", "r = 4", "r = 15"}) history.add(text, "Drag", "drag-1");
    history.add("r = 16", "Drag", "drag-2");
    CHECK(history.undo_label() == "Drag");
    CHECK(history.undo());
    CHECK(history.text() == "r = 15");
    CHECK(history.redo_label() == "Drag");
    CHECK(history.undo());
    CHECK(history.text() == "r = 2");
    CHECK(history.undo_label() == "first");
    CHECK(history.redo());
    CHECK(history.text() == "r = 15");
    // After undoing, the same key begins another step.
    history.add("r = 17", "Drag", "drag-1");
    CHECK_FALSE(history.redo_label());
    CHECK(history.undo());
    CHECK(history.text() == "r = 15");
    history.add("r = 20", "Drag", "drag-3");
    history.add("r = 15", "Drag", "drag-3");
    CHECK(history.undo());
    CHECK(history.text() == "r = 2");
}

TEST_CASE("a text that is the same is no step, and keeps what can be redone") {
    History history("a");
    history.add("b", "b");
    CHECK(history.undo());
    history.add("a", "nothing");
    CHECK(history.redo());
    CHECK(history.text() == "b");
    CHECK_FALSE(history.redo());
}

TEST_CASE("the oldest steps are dropped when the history needs too much memory") {
    History history(std::string(1000, 'a'), 20000);
    for (int i = 0; i < 100; ++i) history.add(std::string(1000, static_cast<char>('b' + i % 20)), "all of it");
    int undone = 0;
    while (history.undo()) ++undone;
    CHECK(undone > 3);
    CHECK(undone < 20);
    History gestures("a", 20000);
    for (int i = 0; i < 100; ++i) gestures.add(i % 2 == 0 ? "b" : "a", "", std::string(1000, 'm') + std::to_string(i));
    for (undone = 0; gestures.undo();) ++undone;
    CHECK(undone > 3);
    CHECK(undone < 20);
    History huge("", 100);
    huge.add(std::string(5000, 'x'), "large");
    CHECK(huge.undo());
    CHECK(huge.text().empty());
}

}  // namespace test_history
