// What `phasetree farm` writes, as far as it goes without a farm; tests/farm has a real one.
#include <algorithm>
#include <sstream>

#include "cut_scene.hpp"

namespace test_farm {

using namespace phasetree::tests;

namespace {

// Exit codes of what shells are told, or −1.
int run_by_shell(const Shell& shell, const std::string& command) {
    const std::string folder = shell.directory.path().string();
    const int status = std::system(("cd '" + folder + "' && " + command).c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

TEST_CASE("the list: any order of its lines but the last, names as awkward as can be, and the bytes of one process") {
    const Shell shell;
    const std::string folder = "it's a \"folder\" of $HOME";
    std::filesystem::create_directory(shell.directory / folder);
    write_text(shell.directory / folder / "-scene.json", cut_scene(5));
    const std::string scene = folder + "/-scene.json";
    REQUIRE(shell.run({"render", scene, "--planes", "all", "--quiet", "-o", "whole.exr"}).code == 0);
    const Outcome o = shell.run({"farm", "list", scene, "--shares", "3", "--parts", folder, "-o", "a.exr", "--program",
                                 PHASETREE_COMMAND, "--", "--planes", "all", "--quiet"});
    REQUIRE_MESSAGE(o.code == 0, o.err);
    std::vector<std::string> lines;
    std::istringstream text(o.out);
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    REQUIRE(lines.size() == 4);
    for (const std::size_t i : {2u, 0u, 1u, 0u, 3u}) {  // one of them twice: it has nothing more to do then
        CAPTURE(lines[i]);
        CHECK(run_by_shell(shell, lines[i] + " 2>/dev/null") == 0);
    }
    CHECK(std::filesystem::exists(shell.directory / folder / "-scene.1-3.part"));
    const bool same = bytes_of(shell.directory / "a.exr") == bytes_of(shell.directory / "whole.exr");
    CHECK(same);
}

TEST_CASE("the script for Slurm is one that bash reads, and submits what the options say") {
    const Shell shell;
    write_text(shell.directory / "scene.json", cut_scene(64));
    const Outcome o = shell.run({"farm", "slurm", "scene.json", "--shares", "8", "--sbatch=--time=60", "-o", "a b.exr",
                                 "--", "--size", "100x80"});
    REQUIRE_MESSAGE(o.code == 0, o.err);
    write_text(shell.directory / "farm.sh", o.out);
    CHECK(run_by_shell(shell, "bash -n farm.sh") == 0);
    for (const char* words : {"--array=0-7", "--requeue", "--time=60", "--dependency=\"afterok:$array\"",
                              "--size 100x80", "SLURM_ARRAY_TASK_ID * 64 / 8", "scene.56-64.part -o 'a b.exr'"})
        CHECK_MESSAGE(o.out.find(words) != std::string::npos, words);
    // Scripts of a task and of the merge, as sbatch would be given them.
    write_text(shell.directory / "sbatch", "#!/bin/sh\ncat >>scripts; echo 1\n");
    CHECK(run_by_shell(shell, "chmod +x sbatch && PATH=$PWD:$PATH bash farm.sh >/dev/null && bash -n scripts") == 0);
    CHECK(bytes_of(shell.directory / "scripts").find("\nfi\nexit \"$code\"\n#!/bin/bash\nexec phasetree merge ") !=
          std::string::npos);
}

TEST_CASE("more shares than one merge reads are merged in steps, and the bytes are those of one process") {
    const Shell shell;
    write_text(shell.directory / "scene.json", cut_scene(11));
    REQUIRE(shell.run({"render", "scene.json", "--quiet", "-o", "whole.exr"}).code == 0);
    const std::vector<std::string> words{"scene.json", "--shares",    "9",         "--merge-width",   "2",
                                         "-o",         "{plane}.exr", "--program", PHASETREE_COMMAND, "--",
                                         "--quiet"};
    const auto farm = [&](const char* kind) {
        std::vector<std::string> all{"farm", kind};
        all.insert(all.end(), words.begin(), words.end());
        const Outcome o = shell.run(all);
        REQUIRE_MESSAGE(o.code == 0, o.err);
        return o.out;
    };
    const auto check_picture = [&] {
        const bool same = bytes_of(shell.directory / "beauty.exr") == bytes_of(shell.directory / "whole.exr");
        CHECK(same);
    };
    // Nine shares become five parts, three and two, which the last line reads.
    const std::string list = farm("list");
    CHECK(std::ranges::count(list, '\n') == 9 + 5 + 3 + 2 + 1);
    write_text(shell.directory / "list.sh", "set -e\n" + list);
    CHECK(run_by_shell(shell, "bash list.sh 2>/dev/null && rm *.part") == 0);
    check_picture();
    // An sbatch that runs what it is given at once, task after task.
    write_text(shell.directory / "farm.sh", farm("slurm"));
    write_text(shell.directory / "sbatch", R"(#!/bin/bash
cat >script
last=0 after=no
for word in "$@"; do
    case $word in --array=0-*) last=${word#--array=0-} ;; --dependency=afterok:1) after=yes ;; esac
done
echo "$last $after" >>submitted
for ((i = 0; i <= last; ++i)); do SLURM_ARRAY_TASK_ID=$i bash script >&2 || exit 1; done
echo 1
)");
    CHECK(run_by_shell(shell, "chmod +x sbatch && rm beauty.exr && PATH=$PWD:$PATH bash farm.sh >/dev/null 2>&1") == 0);
    CHECK(bytes_of(shell.directory / "submitted") == "8 no\n4 yes\n2 yes\n1 yes\n0 yes\n");
    check_picture();
}

TEST_CASE("a farm's picture is denoised when it is merged") {
    const Shell shell;
    write_text(shell.directory / "scene.json", cut_scene(16));
    REQUIRE(shell.run({"render", "scene.json", "--denoise=regression", "--quiet", "-o", "whole.png"}).code == 0);
    const Outcome o = shell.run({"farm", "list", "scene.json", "--shares", "3", "-o", "merged.png", "--program",
                                 PHASETREE_COMMAND, "--", "--denoise=regression", "--quiet"});
    REQUIRE_MESSAGE(o.code == 0, o.err);
    write_text(shell.directory / "list.sh", "set -e\n" + o.out);
    CHECK(run_by_shell(shell, "bash list.sh 2>/dev/null") == 0);
    const bool same = bytes_of(shell.directory / "merged.png") == bytes_of(shell.directory / "whole.png");
    CHECK(same);
}

TEST_CASE("what makes no farm is refused") {
    const Shell shell;
    write_text(shell.directory / "scene.json", cut_scene(4));
    const auto refused = [&](std::vector<std::string> words, const std::string& why) {
        words.insert(words.begin(), "farm");
        const Outcome o = shell.run(words);
        CAPTURE(o.err);
        CHECK(o.code == 2);
        CHECK(o.out.empty());
        CHECK(o.err.find(why) != std::string::npos);
    };
    refused({"cloud", "scene.json", "--shares", "2"}, "\"slurm\" or \"list\", not \"cloud\"");
    refused({"list", "scene.json", "--shares", "5"}, "there are only 4 samples a pixel to share");
    refused({"list", "scene.json", "--shares", "2", "--", "--sample", "1"}, "what follows -- is for render");
    refused({"list", "scene.json", "--shares", "2", "--", "--samples", "0:1"}, "what follows -- is for every share");
    refused({"list", "scene.json", "--shares", "2", "--", "--crop", "9,9,1,1"}, "--crop");
    refused({"list", "-", "--shares", "2"}, "must be a file");
    refused({"list", "scene.json", "--shares", "2", "--program", "a\nb"}, "line feed");
    refused({"list", "scene.json", "--shares", "2", "--merge-width", "1"}, "--merge-width");
    refused({"list", "scene.json", "--shares", "2", "--", "--denoise"}, "8 samples");
    refused({"list", "scene.json", "--shares", "2", "--", "--spp", "9", "--denoise=magic"}, "not \"magic\"");
    refused({"list", "absent.json", "--shares", "2"}, "absent.json");
}

}  // namespace test_farm
