// Balls from PLY and CSV files, and errors for invalid files.
#include <doctest/doctest.h>

#include <string>

#include "phasetree/io/balls.hpp"
#include "phasetree/io/error.hpp"
#include "support/written_files.hpp"

namespace test_ball_files {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

using Files = WrittenFiles<BallList>;

/// The error without the file's name.
std::string said_of(const Files& files, const std::string& name, const std::string& content) {
    const std::string said = files.said(name, content), start = name + ": ";
    REQUIRE(said.starts_with(start));
    return said.substr(start.size());
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
    const Files files(read_balls);
    check_two(files.read("two.csv", "x,y,z,radius,phase\n1,2,3,0.25,0\n-4,0.5,0,1,3\n"));
    check_two(files.read("two.CSV", "# grains\r\nphase, name, z ,y,x,radius\r\n\r\n0,a,3,2,1,0.25\r\n3,,0,.5,-4,1"));
    check_two(files.read("mac.csv", "# grains\rx,y,z,radius,phase\r1,2,3,0.25,0\r\r-4,0.5,0,1,3\r"));
    check_two(files.read("mark.csv", "\xef\xbb\xbf# grains\nx,y,z,radius,phase\n1,2,3,0.25,0\n-4,0.5,0,1,3\n"));
    for (const std::string end : {"\n", "\r", "\r\n"})
        CHECK(files.said("wrong.csv", "x,y,z" + end + end + "1,2,a" + end) ==
              "wrong.csv:3:5: z must be a finite number, but is \"a\"");
    // A name may contain another separator, or look like one of the columns.
    for (const std::string name : {"colour (r,g,b)", "x, y"})
        for (const std::string separator : {";", "\t"}) {
            std::string text;
            for (const char* const cell : {"x", "y", "z", "radius", "phase", name.c_str(), "\n1", "2", "3", "0.25", "0",
                                           "red,\n-4", "0.5", "0", "1", "3", ""})
                text += cell + separator;
            check_two(files.read("named.csv", text));
        }
    // Spreadsheets write empty rows, and some programs pad what they quote.
    check_two(files.read("rows.csv", ",,,,\nx,y,z,radius,phase\n,,,,\n1,2,3,0.25,0\n , ,,,\n-4,0.5,0,1,3\n,,,,\n;;\n"));
    check_two(files.read("quotes.csv",
                         "\" x\",\"y \",z,\" radius \",phase\n\" 1 \",\"2\t\",\" 3\",0.25,\"0 \"\n-4,0.5,0,1,3\n"));
    const BallList bare = files.read("bare.csv", "x,y,z\n1,2,3\n");
    CHECK(bare.centres.size() == 1);
    CHECK(bare.radii.empty());
    CHECK(bare.phases.empty());
    CHECK(files.read("none.csv", "x,y,z\n").centres.empty());
}

TEST_CASE("balls are read from PLY, of words and of numbers in either order of bytes") {
    const Files files(read_balls);
    check_two(
        files.read("two.ply", "ply\nformat ascii 1.0\nelement vertex 2\n" + header + "1 2 3 0.25 0\n-4 0.5 0 1 3\n"));
    for (const bool is_big : {false, true}) {
        std::string rows;
        for (const float v : {1.f, 2.f, 3.f, 0.25f}) rows += bytes(v, is_big);
        rows += '\0';
        for (const float v : {-4.f, 0.5f, 0.f, 1.f}) rows += bytes(v, is_big);
        rows += '\3';
        const std::string format = is_big ? "binary_big_endian" : "binary_little_endian";
        const std::string start = "ply\nformat " + format + " 1.0\nelement vertex ";
        check_two(files.read("two.ply", start + "2\n" + header + rows));
        CHECK(said_of(files, "short.ply", start + "3\n" + header + rows) == "is shorter than its header declares");
        CHECK(said_of(files, "huge.ply", start + "4000000000000\n" + header + rows) ==
              "is shorter than its header declares");
    }
}

TEST_CASE("files that hold no balls are rejected, with the place or the row") {
    const Files files(read_balls);
    CHECK(said_of(files, "a.csv", "") == "has no lines");
    // More tables, and more mistakes in them, are in tests/command/tables.cpp.
    const auto said_of_csv = [&](const std::string& content) {
        const std::string said = files.said("a.csv", content), start = "a.csv:";
        REQUIRE(said.starts_with(start));
        return said.substr(start.size());
    };
    CHECK(said_of_csv("x,y\n1,2\n") == "1:1: the header lacks the column \"z\"; it must name x, y, z");
    CHECK(said_of_csv("1,2,3\n") == "1:1: the header lacks the column \"x\"; it must name x, y, z");
    CHECK(said_of_csv("x,y,z,x\n") == "1:7: the column \"x\" occurs twice");
    CHECK(said_of_csv("x,y,z\n1,2,3\n1,2\n") == "3:4: the row has no z");
    CHECK(said_of_csv("x,y,z\n1,2,three\n") == "2:5: z must be a finite number, but is \"three\"");
    CHECK(said_of_csv("x,y,z,radius\n1,2,3,-1\n") == "2:7: a radius is not positive");
    CHECK(said_of_csv("x,y,z,radius\n1,2,3,1e39\n") == "2:7: a radius is too large");
    CHECK(said_of_csv("x,y,z\n1,2,\" \"\n") == "2:5: the row has no z");
    CHECK(said_of_csv("x,y,z,radius\n1,2,3,nan\n") == "2:7: radius must be a finite number, but is \"nan\"");
    CHECK(said_of_csv("phase,x,y,z\n1.5,2,3,1\n") == "2:1: a phase is not a whole number from 0 to 255");
    CHECK(said_of_csv("x,y,z\n0,1e300,0\n") == "2:3: a coordinate is not a number, or too large");
    CHECK(said_of(files, "a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n") ==
          "its vertices have no column \"y\"; they need x, y and z");
    CHECK(said_of(files, "a.ply", "ply\nformat ascii 1.0\nelement vertex 1\n" + header + "1 2 3 0 0\n") ==
          "a radius is not positive (row 1 of its vertices)");
    CHECK(said_of(files, "a.ply", "ply\nformat ascii 1.0\nend_header\n") ==
          "has no element \"vertex\", which should contain the balls");
    CHECK(said_of(files, "a.obj", "v 1 2 3\n") == "is not a file of balls: its name must end in .ply or .csv");
}

}  // namespace test_ball_files
