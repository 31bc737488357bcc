// A scene file that pages, buttons and other programs change.
#include "studio/edited_document.hpp"

#include <unistd.h>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

#include "output/error.hpp"
#include "phasetree/model/preparation_watch.hpp"

namespace test_edited_document {

using namespace phasetree;
using namespace phasetree::tracer;
using namespace phasetree::tracer::studio;

namespace {

namespace fs = std::filesystem;

// A file, and the document that it is edited by.
class Desk {
  public:
    explicit Desk(const std::string& text, bool saves = true,
                  std::chrono::milliseconds longest_check = std::chrono::seconds(10)) {
        fs::create_directory(folder_);
        write(text);
        document_.emplace(EditedDocument::Options{
            .file = file(),
            .saves = saves,
            .parse = [this](std::string t) { return Document::from_text(std::move(t), file().string()); },
            .check =
                [](const Document& d) {
                    if (d.text().find("wrong") != std::string::npos) throw d.error(d.root(), "this is wrong");
                    // As nodes do that are never prepared.
                    while (d.text().find("endless") != std::string::npos)
                        if (PreparationWatch::current()->cancelled()) throw PreparationCancelled();
                },
            .longest_check = longest_check});
        document_->on_change([this] { ++changes; });
    }
    ~Desk() { fs::remove_all(folder_); }

    EditedDocument& document() { return *document_; }
    fs::path file() const { return folder_ / "scene.json"; }
    void write(const std::string& text) const { std::ofstream(file(), std::ios::binary) << text; }
    std::string on_disk() const {
        std::ifstream in(file(), std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    std::string text() { return *document().state()->text; }
    // Looks at the file as the server does.
    void look() {
        for (int i = 0; i < 3; ++i) document().poll_file();
    }
    std::uint64_t set(const std::string& pointer, const std::string& to, std::uint64_t base,
                      const std::optional<std::string>& merge = {}) {
        return document().edit(EditRequest{base, "Set " + pointer, merge, false, {SetValue{pointer, to}}});
    }
    std::uint64_t version() { return document().state()->version; }

    int changes = 0;

  private:
    fs::path folder_ = fs::temp_directory_path() / fmt::format("phasetree-desk-{}", ::getpid());
    std::optional<EditedDocument> document_;
};

constexpr const char* text = "{\"a\": 1, \"list\": [1, 2, 3]}\n";

}  // namespace

TEST_CASE("each step is saved at once, with the file's permissions, and undone and redone") {
    Desk desk(text);
    fs::permissions(desk.file(), fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read);
    const auto permissions = fs::status(desk.file()).permissions();
    const std::uint64_t first = desk.version();
    CHECK(desk.set("/a", "2", first) > first);
    CHECK(desk.on_disk() == "{\"a\": 2, \"list\": [1, 2, 3]}\n");
    CHECK(fs::status(desk.file()).permissions() == permissions);
    CHECK(desk.document().state()->undo == "Set /a");
    CHECK(desk.changes == 1);
    desk.document().undo();
    CHECK(desk.on_disk() == text);
    CHECK(desk.document().state()->redo == "Set /a");
    desk.document().redo();
    CHECK(desk.on_disk() == desk.text());
    const std::uint64_t last = desk.version();
    CHECK(desk.document().redo() == last);
    // What it wrote itself is no change from outside.
    desk.look();
    CHECK(desk.version() == last);
}

TEST_CASE("operations of a request are applied all or not at all") {
    Desk desk(text);
    const std::uint64_t version = desk.version();
    EditRequest request{version, "Two", {}, false, {SetValue{"/a", "2"}, RemoveValue{"/list/7"}}};
    CHECK_THROWS_AS(desk.document().edit(request), SceneError);
    CHECK(desk.on_disk() == text);
    CHECK(desk.version() == version);
    request.operations = {SetValue{"/a", "\"wrong\""}};
    request.is_strict = true;
    CHECK_THROWS_AS(desk.document().edit(request), SceneError);
    request.operations = {ReplaceText{"{"}};
    CHECK_THROWS_AS(desk.document().edit(request), SceneError);
    CHECK(desk.text() == text);
    request.is_strict = false;
    desk.document().edit(request);
    CHECK(desk.text() == "{");
    CHECK(desk.document().state()->error);
    CHECK_THROWS_AS(desk.set("/a", "1", desk.version()), SceneError);
    desk.document().undo();
    CHECK(desk.text() == text);
}

TEST_CASE("a check that never ends neither changes anything nor blocks what follows") {
    Desk desk(text, true, std::chrono::milliseconds(100));
    const EditRequest endless{desk.version(), "Endless", {}, true, {SetValue{"/a", "\"endless\""}}};
    CHECK_THROWS_WITH_AS(desk.document().edit(endless), doctest::Contains("takes more than 0.1 s"), SceneError);
    CHECK(desk.on_disk() == text);
    desk.set("/a", "2", desk.version());
    CHECK(desk.text() == "{\"a\": 2, \"list\": [1, 2, 3]}\n");
}

TEST_CASE("stopping ends a check") {
    Desk desk(text, true, std::chrono::hours(1));
    const EditRequest endless{desk.version(), "Endless", {}, true, {SetValue{"/a", "\"endless\""}}};
    std::thread stopping([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        desk.document().stop();
    });
    CHECK_THROWS_AS(desk.document().edit(endless), SceneError);
    stopping.join();
    CHECK(desk.on_disk() == text);
}

TEST_CASE("a scene that was checked before the step needs no second check") {
    Desk desk(text);
    CHECK_FALSE(desk.document().state()->is_checked);
    desk.document().edit(EditRequest{desk.version(), "Set", {}, true, {SetValue{"/a", "2"}}});
    CHECK(desk.document().state()->is_checked);
    desk.document().record_check(desk.document().state()->text_version, SceneError("scene.json", "a missing file"));
    CHECK(desk.document().state()->error);
    desk.document().edit(EditRequest{desk.version(), "Set", {}, true, {SetValue{"/a", "3"}}});
    CHECK_FALSE(desk.document().state()->error);
    desk.set("/a", "4", desk.version());
    CHECK_FALSE(desk.document().state()->is_checked);
}

TEST_CASE("what another program saves is a step") {
    Desk desk(text);
    desk.set("/a", "2", desk.version());
    desk.write("{\"a\": 5}");
    desk.look();
    CHECK(desk.text() == "{\"a\": 5}");
    CHECK(desk.document().state()->undo == "Change made in another program");
    // An invalid text is shown, and repairing it belongs to the same step.
    desk.write("{\"a\": ");
    desk.look();
    CHECK(desk.document().state()->error->line() == 1);
    CHECK_FALSE(desk.document().state()->document);
    desk.write("{\"a\": 6}");
    desk.look();
    CHECK(desk.document().state()->document);
    desk.document().undo();
    desk.document().undo();
    CHECK(desk.text() == "{\"a\": 5}");
    desk.document().undo();
    desk.document().undo();
    CHECK(desk.on_disk() == text);
    // A request takes over what was saved just before it.
    desk.write("{\"a\": 8, \"b\": 9}");
    desk.set("/a", "10", desk.version());
    CHECK(desk.on_disk() == "{\"a\": 10, \"b\": 9}");
}

TEST_CASE("a file that vanishes is reported, and the next change writes it again") {
    Desk desk(text);
    fs::remove(desk.file());
    desk.look();
    CHECK(desk.document().state()->unreadable);
    CHECK_THROWS_AS(desk.document().edit("Write", [](const Document& d) { return d.text() + " "; }), SceneError);
    CHECK_FALSE(fs::exists(desk.file()));
    desk.set("/a", "2", desk.version());
    CHECK(desk.on_disk() == desk.text());
    CHECK_FALSE(desk.document().state()->unreadable);
}

TEST_CASE("saving a text whose file has vanished reports that the file can be read again") {
    Desk desk(text);
    fs::remove(desk.file());
    desk.look();
    CHECK(desk.changes == 1);
    desk.document().save();
    CHECK_FALSE(desk.document().state()->unreadable);
    CHECK(desk.changes == 2);
    desk.document().save();
    CHECK(desk.changes == 2);
}

TEST_CASE("an older request is applied if it means the same, and is a conflict otherwise") {
    Desk desk(text);
    const std::uint64_t first = desk.version();
    desk.set("/a", "2", first);
    desk.set("/a", "3", first);
    CHECK(desk.text() == "{\"a\": 3, \"list\": [1, 2, 3]}\n");
    const auto edit = [&](Operation operation) {
        desk.document().edit(EditRequest{first, "Older", {}, false, {std::move(operation)}});
    };
    edit(RemoveValue{"/list/0"});
    CHECK(desk.text() == "{\"a\": 3, \"list\": [2, 3]}\n");
    CHECK_THROWS_AS(edit(RemoveValue{"/list/0"}), ConflictError);
    CHECK_THROWS_AS(edit(SetValue{"/list/0", "7"}), ConflictError);
    CHECK_THROWS_AS(edit(RemoveValue{"/a"}), ConflictError);
    CHECK_THROWS_AS(edit(ReplaceText{"{}"}), ConflictError);
    edit(SetValue{"/new", "1"});
    CHECK(desk.text() == "{\"a\": 3, \"list\": [2, 3], \"new\": 1}\n");
    CHECK_THROWS_AS(edit(InsertValue{"/new", "1"}), ConflictError);
    CHECK_THROWS_AS(desk.set("/a", "1", desk.version() + 1), ConflictError);
    for (int i = 0; i < 100; ++i) desk.set("/a", std::to_string(i), desk.version());
    CHECK_THROWS_AS(desk.set("/a", "1", first), ConflictError);
}

TEST_CASE("without automatic saving the file changes when asked") {
    Desk desk(text, false);
    desk.set("/a", "2", desk.version());
    CHECK(desk.on_disk() == text);
    CHECK_FALSE(desk.document().state()->is_saved);
    desk.document().undo();
    CHECK(desk.document().state()->is_saved);
    desk.document().redo();
    desk.document().save();
    CHECK(desk.on_disk() == desk.text());
    CHECK(desk.document().state()->is_saved);
    // A file that cannot be written is reported, and nothing is lost.
    desk.set("/a", "3", desk.version());
    fs::remove(desk.file());
    fs::create_directory(desk.file());
    CHECK_THROWS_AS(desk.document().save(), OutputError);
    CHECK_FALSE(desk.document().state()->save_error.empty());
    CHECK(desk.text().find("\"a\": 3") != std::string::npos);
}

TEST_CASE("what is too large or too much is rejected") {
    Desk desk(text);
    const auto edit = [&](std::vector<Operation> operations) {
        desk.document().edit(EditRequest{desk.version(), "Large", {}, false, std::move(operations)});
    };
    CHECK_THROWS_AS(edit({ReplaceText{std::string(EditedDocument::most_bytes_of_text + 1, ' ')}}), SceneError);
    CHECK_THROWS_AS(edit(std::vector<Operation>(EditedDocument::most_operations + 1, SetValue{"/a", "1"})), SceneError);
    std::vector<Operation> costly{ReplaceText{"[1" + std::string(1 << 20, ' ') + "]"}};
    costly.resize(400, SetValue{"/0", "1"});
    CHECK_THROWS_AS(edit(std::move(costly)), SceneError);
    std::vector<Operation> deep(900, WrapValue{"/a", "[[null]]"});
    CHECK_THROWS_AS(edit(std::move(deep)), SceneError);
    CHECK(desk.text() == text);
}

TEST_CASE("threads that edit at the same time lose nothing") {
    Desk desk("{\"a\": 0, \"b\": 0}");
    const auto work = [&](const char* pointer) {
        for (int i = 1; i <= 50; ++i) desk.set(pointer, std::to_string(i), desk.version());
    };
    std::thread other([&] { work("/a"); });
    work("/b");
    other.join();
    CHECK(desk.on_disk() == "{\"a\": 50, \"b\": 50}");
    int undone = 0;
    while (desk.text() != "{\"a\": 0, \"b\": 0}") {
        desk.document().undo();
        ++undone;
    }
    CHECK(undone == 100);
}

}  // namespace test_edited_document
