#include "output/late_progress.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "environment.hpp"
#include "output/preparation_progress.hpp"
#include "output/progress.hpp"

namespace test_progress {

using namespace phasetree::tracer;
using namespace phasetree::tracer::test;
using namespace std::chrono_literals;

namespace {

// A stream, and a clock that the test moves.
struct Screen {
    std::ostringstream stream;
    ProgressOutput::Clock::time_point now{};
    int columns = 100;

    ProgressOutput output(bool terminal) {
        return {&stream, terminal, [this] { return columns; }, [this] { return now; }};
    }
    std::string take() {
        std::string text = stream.str();
        stream.str("");
        return text;
    }
};

// What is to be seen of a frame "\r...\x1b[K"; empty if it is not one.
std::string visible(const std::string& frame) {
    const std::string end = "\x1b[K";
    if (frame.size() < 4 || frame.front() != '\r' || frame.substr(frame.size() - 3) != end) return "";
    return frame.substr(1, frame.size() - 4);
}

}  // namespace

TEST_CASE("a log gets one line for every five percent, and 100 at the end") {
    Screen screen;
    {
        Progress progress(1000, screen.output(false));
        CHECK(screen.take() == "Progress: 0%\n");
        progress.advance(49);
        CHECK(screen.take() == "");
        screen.now += 2s;
        progress.advance(1);
        CHECK(screen.take() == "Progress: 5%, 0:02 elapsed, ETA 0:38\n");
        progress.advance(0);
        CHECK(screen.take() == "");
        screen.now += 60s;
        progress.advance(284);
        // The first two seconds are forgotten but for e⁻⁶: 4.735 a second.
        CHECK(screen.take() == "Progress: 30%, 1:02 elapsed, ETA 2:21\n");
        screen.now += 600s;
        progress.advance(665);
        CHECK(screen.take() == "Progress: 95%, 11:02 elapsed, ETA 0:01\n");
        progress.advance(1);
        CHECK(screen.take() == "Progress: 100%, 11:02 elapsed\n");
        progress.advance(5);
        progress.finish();
    }
    CHECK(screen.take() == "");
}

TEST_CASE("every multiple of five percent is hit exactly, whatever the total") {
    for (const std::uint64_t total : {20u, 100u, 140u, 700u, 6000u}) {
        Screen screen;
        Progress progress(total, screen.output(false));
        screen.take();
        for (std::uint64_t done = 1; done <= total; ++done) {
            progress.advance(1);
            REQUIRE(screen.take().empty() == ((done * 20) % total != 0));
        }
    }
    Screen empty;
    Progress nothing(0, empty.output(false));
    CHECK(empty.take() == "Progress: 100%, 0:00 elapsed\n");
}

TEST_CASE("after an interruption the lines end where the work ended") {
    Screen screen;
    {
        Progress progress(100, screen.output(false));
        progress.advance(57);
    }
    CHECK(screen.take() == "Progress: 0%\nProgress: 55%, 0:00 elapsed, ETA -:--\n");
}

TEST_CASE("a terminal gets a bar with percentage, samples, time and estimate") {
    Screen screen;
    {
        Progress progress(20'000'000, screen.output(true));
        CHECK(visible(screen.take()).find("  0% [   ") == 0);
        for (int i = 0; i < 50; ++i) {
            screen.now += 100ms;
            progress.advance(200'000);
        }
        screen.take();
        screen.now += 100ms;
        progress.advance(0);
        const std::string line = visible(screen.take());
        CHECK(line.find(" 50% [") == 0);
        CHECK(contains(line, "10.0M/20.0M samples, 0:05 elapsed, ETA 0:05"));
        CHECK(contains(line, "=] ") == false);
        CHECK(contains(line, "=  "));
        // Half of the bar is filled.
        const auto filled = std::count(line.begin(), line.end(), '=');
        const auto width = static_cast<long>(line.find(']') - line.find('[')) - 1;
        CHECK(std::abs(2 * filled - width) <= 1);
    }
    CHECK(screen.take() == "\r\x1b[K");
}

TEST_CASE("every percent is hit exactly") {
    Screen screen;
    Progress progress(100, screen.output(true));
    for (int percent = 1; percent <= 100; ++percent) {
        screen.take();
        screen.now += 1s;
        progress.advance(1);
        REQUIRE(std::stoi(visible(screen.take())) == percent);
    }
}

TEST_CASE("the bar is drawn at most ten times a second") {
    Screen screen;
    Progress progress(100'000, screen.output(true));
    for (int i = 0; i < 10'000; ++i) {
        screen.now += 1ms;
        progress.advance(10);
    }
    const std::string text = screen.take();
    const auto frames = std::count(text.begin(), text.end(), '\r');
    CHECK(frames <= 101);
    CHECK(frames >= 99);
}

TEST_CASE("the estimate follows a change of speed, smoothly") {
    Screen screen;
    Progress progress(100'000, screen.output(true));
    for (int i = 0; i < 100; ++i) {
        screen.now += 100ms;
        progress.advance(100);  // 1000 a second
    }
    for (int i = 0; i < 600; ++i) {
        screen.now += 100ms;
        progress.advance(10);  // then 100 a second, for a minute: 84,000 are left, 840 s
    }
    // The fast part still counts exp(−6) = 0.25 %, ten times as fast: 2.2 % off, 14:00 becomes 13:42.
    const std::string text = screen.take();
    const std::string last = visible(text.substr(text.rfind('\r')));
    CHECK(contains(last, "1:10 elapsed, ETA 13:4"));
}

TEST_CASE("the line fits the terminal") {
    std::set<std::size_t> lengths;
    for (int columns = 1; columns < 200; ++columns) {
        Screen screen;
        screen.columns = columns;
        Progress progress(1000, screen.output(true));
        screen.take();
        screen.now += 1h;
        progress.advance(400);
        const std::string line = visible(screen.take());
        if (columns > 5) REQUIRE(static_cast<int>(line.size()) < columns);
        REQUIRE(line.find(" 40%") == 0);
        if (columns >= 80) {
            CHECK(contains(line, "] 400/1.0k samples, 1:00:00 elapsed, ETA 1:30:00"));
        }
        lengths.insert(line.size());
    }
    CHECK(lengths.size() > 30);
}

TEST_CASE("quiet is quiet") {
    Progress progress(100, ProgressOutput::standard_error(true));
    progress.advance(100);
    progress.finish();
    CHECK(ProgressOutput::standard_error(true).stream == nullptr);
    CHECK(ProgressOutput::standard_error(false).stream != nullptr);
}

TEST_CASE("threads may advance together") {
    for (const bool terminal : {false, true}) {
        std::ostringstream stream;
        {
            ProgressOutput output;
            output.stream = &stream;
            output.terminal = terminal;
            Progress progress(40'000, output);
            std::vector<std::jthread> threads;
            for (int t = 0; t < 4; ++t) {
                threads.emplace_back([&] {
                    for (int i = 0; i < 10'000; ++i) progress.advance(1);
                });
            }
        }
        if (!terminal) {
            std::istringstream lines(stream.str());
            int previous = -5;
            for (std::string line; std::getline(lines, line);) {
                REQUIRE(line.find("Progress: ") == 0);
                const int percent = std::stoi(line.substr(10));
                CHECK(percent > previous);
                CHECK(percent % 5 == 0);
                previous = percent;
            }
            CHECK(previous == 100);
        }
    }
}

TEST_CASE("what is done within a second is never shown, and what takes longer is from then on") {
    Screen screen;
    {
        LateProgress quick(screen.output(false), "reading");
        quick.tell(0.2);
        screen.now += 900ms;
        quick.tell(0.9);
        screen.now += 900ms;
        quick.tell(1);
    }
    CHECK(screen.take() == "");
    {
        LateProgress slow(screen.output(false), "reading");
        slow.tell(0.1);
        screen.now += 2s;
        slow.tell(0.25);
        CHECK(screen.take() == "reading: 0%\nreading: 25%, 0:00 elapsed, ETA -:--\n");
        screen.now += 1s;
        slow.tell(0.2);  // less than before is nothing new
        slow.tell(0.5);
        CHECK(screen.take() == "reading: 50%, 0:01 elapsed, ETA 0:01\n");
        slow.tell(1);
        CHECK(screen.take() == "reading: 100%, 0:01 elapsed\n");
    }
    LateProgress silent({}, "reading");
    silent.tell(0.5);
    CHECK(screen.take() == "");
}

TEST_CASE("the preparation of each large mesh is shown") {
    Screen screen;
    const PreparationProgress progress(screen.output(false));
    const auto tell = [](float share) { phasetree::PreparationWatch::current()->progress("mesh", share); };
    tell(0);
    tell(0.5f);
    tell(1);
    CHECK(screen.take() == "");
    for (int mesh = 0; mesh < 2; ++mesh) {
        tell(0);
        screen.now += 2s;
        tell(0.25f);
        CHECK(screen.take() == "preparing a mesh: 0%\npreparing a mesh: 25%, 0:00 elapsed, ETA -:--\n");
        tell(1);
        CHECK(screen.take() == "preparing a mesh: 100%, 0:00 elapsed\n");
    }
    {
        const PreparationProgress quiet({});
        tell(0);
        screen.now += 2s;
        tell(0.5f);
        CHECK(screen.take() == "");
    }
}

}  // namespace test_progress
