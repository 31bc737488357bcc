// Balls from PLY and CSV files, and what is said of files that are none.
#include <doctest/doctest.h>

#include <bit>
#include <filesystem>
#include <fstream>

#include "phasetree/io/balls.hpp"
#include "phasetree/io/error.hpp"
#include "phasetree_support/temporary_directory.hpp"

using namespace phasetree;

namespace {

class Files {
  public:
    BallList read(const std::string& name, const std::string& content) const {
        const std::filesystem::path path = folder_.path() / name;
        std::ofstream(path, std::ios::binary) << content;
        return read_balls(path);
    }
    /// The error without the file's name.
    std::string said_of(const std::string& name, const std::string& content) const {
        try {
            read(name, content);
        } catch (const SceneError& e) {
            const std::string text = e.what();
            return text.substr(text.find(name) + name.size() + 2);
        }
        return "balls";
    }

  private:
    support::TemporaryDirectory folder_;
};

std::string bytes_of(float v, bool is_big) {
    const auto bits = std::bit_cast<std::uint32_t>(v);
    std::string bytes;
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(bits >> (8 * (is_big ? 3 - i : i)) & 0xff);
    return bytes;
}

void check_two(const BallList& list) {
    REQUIRE(list.centres.size() == 2);
    CHECK(list.centres[0] == glm::vec3(1, 2, 3));
    CHECK(list.centres[1] == glm::vec3(-4, 0.5f, 0));
    CHECK(list.radii == std::vector<float>{0.25f, 1});
    CHECK(list.phases == std::vector<std::uint8_t>{0, 3});
}

const std::string header =
    "property float x\nproperty float y\nproperty float z\nproperty float radius\nproperty uchar phase\nend_header\n";

}  // namespace

TEST_CASE("balls are read from CSV, with columns in any order and others among them") {
    const Files files;
    check_two(files.read("two.csv", "x,y,z,radius,phase\n1,2,3,0.25,0\n-4,0.5,0,1,3\n"));
    check_two(files.read("two.CSV", "# grains\r\nphase, name, z ,y,x,radius\r\n\r\n0,a,3,2,1,0.25\r\n3,,0,.5,-4,1"));
    const BallList bare = files.read("bare.csv", "x,y,z\n1,2,3\n");
    CHECK(bare.centres.size() == 1);
    CHECK(bare.radii.empty());
    CHECK(bare.phases.empty());
    CHECK(files.read("none.csv", "x,y,z\n").centres.empty());
}

TEST_CASE("balls are read from PLY, of words and of numbers in either order of bytes") {
    const Files files;
    check_two(
        files.read("two.ply", "ply\nformat ascii 1.0\nelement vertex 2\n" + header + "1 2 3 0.25 0\n-4 0.5 0 1 3\n"));
    for (const bool is_big : {false, true}) {
        std::string rows;
        for (const float v : {1.f, 2.f, 3.f, 0.25f}) rows += bytes_of(v, is_big);
        rows += '\0';
        for (const float v : {-4.f, 0.5f, 0.f, 1.f}) rows += bytes_of(v, is_big);
        rows += '\3';
        const std::string format = is_big ? "binary_big_endian" : "binary_little_endian";
        const std::string start = "ply\nformat " + format + " 1.0\nelement vertex ";
        check_two(files.read("two.ply", start + "2\n" + header + rows));
        CHECK(files.said_of("short.ply", start + "3\n" + header + rows) == "is shorter than its header says");
        CHECK(files.said_of("huge.ply", start + "4000000000000\n" + header + rows) ==
              "is shorter than its header says");
    }
}

TEST_CASE("files that hold no balls are refused, with the line or the row") {
    const Files files;
    CHECK(files.said_of("a.csv", "") == "has no lines");
    CHECK(files.said_of("a.csv", "x,y\n1,2\n") ==
          "the first line names no column \"z\"; they need x, y and z (line 1)");
    CHECK(files.said_of("a.csv", "x,y,z,x\n") == "there are two columns \"x\" (line 1)");
    CHECK(files.said_of("a.csv", "x,y,z\n1,2,3\n1,2\n") == "its z is missing (line 3)");
    CHECK(files.said_of("a.csv", "x,y,z\n1,2,three\n") == "its z is not a number (line 2)");
    CHECK(files.said_of("a.csv", "x,y,z,radius\n1,2,3,-1\n") == "a radius is not positive (line 2)");
    CHECK(files.said_of("a.csv", "x,y,z,radius\n1,2,3,nan\n") == "its radius is not a number (line 2)");
    CHECK(files.said_of("a.csv", "x,y,z,phase\n1,2,3,1.5\n") == "a phase is not a whole number from 0 to 255 (line 2)");
    CHECK(files.said_of("a.csv", "x,y,z\n1e300,0,0\n") == "a coordinate is no number, or too large (line 2)");
    CHECK(files.said_of("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n") ==
          "its vertices have no column \"y\"; they need x, y and z");
    CHECK(files.said_of("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\n" + header + "1 2 3 0 0\n") ==
          "a radius is not positive (row 1 of its elements)");
    CHECK(files.said_of("a.ply", "ply\nformat ascii 1.0\nend_header\n") == "has no vertices, which would be the balls");
    CHECK(files.said_of("a.obj", "v 1 2 3\n") == "has no balls: its name must end with .ply or .csv");
}
