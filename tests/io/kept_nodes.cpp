// Nodes made from files: when a scene is read again, they are reused from the previous read, but only if nothing has
// changed.
#include "phasetree/io/kept_nodes.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>

#include "phasetree/io/error.hpp"
#include "phasetree/io/tree.hpp"
#include "phasetree/nodes/fields/height_grid.hpp"
#include "phasetree_support/temporary_directory.hpp"

namespace test_kept_nodes {

using namespace phasetree;
namespace fs = std::filesystem;

namespace {

const std::string hill = R"({"height_map": {"file": "hill.map", "size_x": 1, "size_y": 1, "height": 0.5}})";

std::string scene(const std::string& first, const std::string& second) {
    return R"({"phases": {"a": {}, "b": {}}, "tree": {"under": [{"set": {"phase": "a", "of": )" + first +
           R"(}}, {"set": {"phase": "b", "of": )" + second + "}}]}}";
}

/// A folder with a file, whose content is one digit, and a reader that counts its calls.
class Place {
  public:
    Place() { save('3', std::chrono::hours(2)); }

    void save(char content, std::chrono::seconds ago) {
        std::ofstream(file(), std::ios::trunc) << content;
        fs::last_write_time(file(), fs::file_time_type::clock::now() - ago);
    }
    fs::path file() const { return folder_.path() / "hill.map"; }

    SceneTree read(const std::string& text) {
        kept_->start();
        FileReaders readers;
        const auto read_digit = [this](const fs::path& path, const std::string&) {
            ++times_read;
            char content = '0';
            std::ifstream(path) >> content;
            const float height = static_cast<float>(content - '0') / 10;
            return HeightGrid{2, 2, {height, height, height, height}};
        };
        readers.add<HeightGrid>({.read = read_digit});
        const Document document = Document::from_text(text, (folder_.path() / "scene.json").string());
        SceneTree tree = read_tree(document.with_kept_nodes(kept_), readers);
        kept_->finish();
        return tree;
    }

    int times_read = 0;

  private:
    support::TemporaryDirectory folder_;
    std::shared_ptr<KeptNodes> kept_ = std::make_shared<KeptNodes>();
};

Phase at(const SceneTree& tree, float z) {
    return label(distances(tree.object, {0.01f, 0.01f, z}));
}

}  // namespace

TEST_CASE("what did not change is not read again") {
    Place place;
    const std::string text = scene(hill, R"({"sphere": {"radius": 0.1}})");
    const SceneTree first = place.read(text), second = place.read(text + "\n");
    CHECK(place.times_read == 1);
    CHECK(at(first, 0.12f) == at(second, 0.12f));
    CHECK(place.read(scene(hill, R"({"sphere": {"radius": 0.2}})")).object);
    CHECK(place.times_read == 1);
}

TEST_CASE("another parameter, another file and another state of the file are read") {
    Place place;
    const std::string ball = R"({"sphere": {"radius": 0.01}})";
    REQUIRE(at(place.read(scene(hill, ball)), 0.12f) == Phase{1});

    SUBCASE("a parameter") {
        std::string other = hill;
        other.replace(other.find("0.5"), 3, "0.2");
        CHECK(at(place.read(scene(other, ball)), 0.12f) == vacuum);
        CHECK(place.times_read == 2);
    }
    SUBCASE("the content, of the same length") {
        place.save('1', std::chrono::hours(1));
        CHECK(at(place.read(scene(hill, ball)), 0.12f) == vacuum);
        CHECK(place.times_read == 2);
    }
    SUBCASE("another file of the same time in its place") {
        const auto time = fs::last_write_time(place.file());
        const fs::path beside = place.file().string() + ".new";
        std::ofstream(beside) << '1';
        fs::last_write_time(beside, time);
        fs::rename(beside, place.file());
        CHECK(at(place.read(scene(hill, ball)), 0.12f) == vacuum);
    }
    SUBCASE("one that was there by another name") {
        fs::copy_file(place.file(), place.file().parent_path() / "other.map");
        std::string other = hill;
        other.replace(other.find("hill"), 4, "other");
        CHECK(place.read(scene(other, ball)).object);
        CHECK(place.times_read == 2);
    }
    SUBCASE("a file that is gone") {
        fs::remove(place.file());
        CHECK(at(place.read(scene(hill, ball)), 0.12f) == vacuum);
        CHECK(place.times_read == 2);
    }
}

TEST_CASE("a file that was only just saved is read again, for it may be saved again in the same instant") {
    Place place;
    place.save('3', std::chrono::seconds(0));
    const std::string text = scene(hill, R"({"sphere": {"radius": 0.01}})");
    (void)place.read(text);
    place.save('1', std::chrono::seconds(0));
    CHECK(at(place.read(text), 0.12f) == vacuum);
    CHECK(place.times_read == 2);
}

TEST_CASE("equal nodes at two places are two") {
    Place place;
    const std::string twice = scene(hill, R"({"translate": {"by": [0, 0, 1], "of": )" + hill + "}}");
    const std::size_t nodes = statistics(place.read(twice).object).nodes;
    const int read_first = place.times_read;
    CHECK(statistics(place.read(twice).object).nodes == nodes);
    CHECK(place.times_read == read_first);
}

TEST_CASE("what a reading that failed took is there for the next, and what none needs is forgotten") {
    Place place;
    const std::string good = scene(hill, R"({"sphere": {"radius": 0.01}})");
    (void)place.read(good);
    CHECK_THROWS_AS(place.read(scene(hill, R"({"sphere": {"radius": -1}})")), SceneError);
    CHECK_THROWS_AS(place.read(scene(R"({"sphere": {"radius": -1}})", hill)), SceneError);
    (void)place.read(good);
    CHECK(place.times_read == 1);
    (void)place.read(scene(R"({"sphere": {"radius": 1}})", R"({"sphere": {"radius": 2}})"));
    (void)place.read(good);
    CHECK(place.times_read == 2);
}

}  // namespace test_kept_nodes
