// The output of `phasetree farm`, as far as it can be tested without a farm; tests/farm uses a real one.
#include <algorithm>
#include <numeric>
#include <sstream>

#include "cut_scene.hpp"

namespace test_farm {

using namespace phasetree::tests;

namespace {

// The exit code of a shell command, or −1.
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
    for (const char* words : {"--size 100x80", "share * 64 / 8", "scene.56-64.part -o 'a b.exr'"})
        CHECK_MESSAGE(o.out.find(words) != std::string::npos, words);
    // Scripts of a task and of the merge, as sbatch would be given them. With several clusters it prints
    // "NUMBER;CLUSTER".
    write_text(shell.directory / "sbatch", "#!/bin/sh\necho \"$*\" >>calls; cat >>scripts; echo '1;here'\n");
    CHECK(run_by_shell(shell, "chmod +x sbatch && PATH=$PWD:$PATH bash farm.sh >/dev/null && bash -n scripts") == 0);
    CHECK(bytes_of(shell.directory / "scripts").find("\nfi\nexit \"$code\"\n#!/bin/bash\nexec phasetree merge ") !=
          std::string::npos);
    CHECK(bytes_of(shell.directory / "calls") ==
          "--parsable --array=0-7 --job-name=phasetree --requeue --open-mode=append --signal=B:TERM@60 --time=60\n"
          "--parsable --job-name=phasetree-merge --dependency=afterok:1 --time=60\n");
}

namespace {

// A scene of many samples, and a Slurm that runs nothing: it writes a line for each job, and the shares of its tasks.
void write_pretended_slurm(const Shell& shell) {
    write_text(shell.directory / "scene.json", cut_scene(5003));
    write_text(shell.directory / "sbatch", R"bash(#!/bin/bash
cat >script
array=none dependency=none number=$(($(cat number 2>/dev/null || echo 0) + 1))
for word in "$@"; do
    case $word in --array=*) array=${word#--array=} ;; --dependency=*) dependency=${word#--dependency=} ;; esac
done
[ ! -e refuse_from ] || [ "$number" -lt "$(cat refuse_from)" ] || exit 1
echo "$number" >number
echo "$array $dependency" >>jobs
task=$(grep '^share=' script)
last=${array#0-}
[ -z "$task" ] || for ((SLURM_ARRAY_TASK_ID = 0; SLURM_ARRAY_TASK_ID <= ${last%%%*}; ++SLURM_ARRAY_TASK_ID)); do
    eval "$task"
    echo "$share"
done >>shares
echo "$number"
)bash");
    write_text(shell.directory / "scontrol",
               "#!/bin/sh\n[ -e config ] || exit 1\necho 'MaxArrayJobs            = 7'\ncat config\n");
    write_text(shell.directory / "scancel", "#!/bin/sh\necho \"$*\" >>cancelled\n");
    REQUIRE(run_by_shell(shell, "chmod +x sbatch scontrol scancel") == 0);
}

// Submits to that Slurm. Returns the exit code of the script.
int submit(const Shell& shell, const std::vector<std::string>& options) {
    const Outcome o = shell.run(joined({"farm", "slurm", "scene.json"}, options));
    REQUIRE_MESSAGE(o.code == 0, o.err);
    write_text(shell.directory / "farm.sh", o.out);
    return run_by_shell(shell, "rm -f jobs shares number cancelled; PATH=$PWD:$PATH bash farm.sh >last");
}

std::vector<std::string> lines_of(const Shell& shell, const char* file) {
    std::vector<std::string> lines;
    std::istringstream text(bytes_of(shell.directory / file));
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
}

// "0-1000%16": 1000.
int last_task(const std::string& job) {
    return job.starts_with("0-") ? std::stoi(job.substr(2)) : 0;
}

}  // namespace

TEST_CASE("arrays are no longer than Slurm allows, and every share is in exactly one of them") {
    const Shell shell;
    write_pretended_slurm(shell);
    for (const auto& [config, longest] : {std::pair("", 1001), std::pair("MaxArraySize            = 1001\n", 1001),
                                          std::pair("MaxArraySize            = 300\n", 300),
                                          std::pair("MaxArraySize            = 4000001\n", 4000001)}) {
        CAPTURE(config);
        std::filesystem::remove(shell.directory / "config");
        if (*config != '\0') write_text(shell.directory / "config", config);
        for (const int shares : {1, 1000, 1001, 1002, 5000}) {
            CAPTURE(shares);
            REQUIRE(submit(shell, {"--shares", std::to_string(shares), "--merge-width", "4"}) == 0);
            std::vector<int> submitted;
            for (const std::string& line : lines_of(shell, "shares")) submitted.push_back(std::stoi(line));
            std::ranges::sort(submitted);
            std::vector<int> wanted(static_cast<std::size_t>(shares));
            std::iota(wanted.begin(), wanted.end(), 0);
            CHECK(submitted == wanted);
            const std::vector<std::string> jobs = lines_of(shell, "jobs");
            for (const std::string& job : jobs) CHECK_MESSAGE(last_task(job) < longest, job);
            // The shares wait for nothing, the first merges for all arrays of shares.
            const int arrays = (shares + longest - 1) / longest;
            std::string all = "afterok";
            for (int i = 1; i <= arrays; ++i) all += ":" + std::to_string(i);
            for (int i = 0; i < arrays; ++i) CHECK(jobs[static_cast<std::size_t>(i)].ends_with(" none"));
            CHECK(jobs[static_cast<std::size_t>(arrays)].ends_with(" " + all));
            CHECK(lines_of(shell, "last") == std::vector{std::to_string(jobs.size())});
        }
    }
}

TEST_CASE("no more shares run at a time than --max-running says, in however many arrays they are") {
    const Shell shell;
    write_pretended_slurm(shell);
    REQUIRE(submit(shell, {"--shares", "2500", "--max-running", "16"}) == 0);
    CHECK(bytes_of(shell.directory / "jobs") ==
          "0-1000%16 none\n0-1000%16 afterany:1\n0-497%16 afterany:2\n0-39%16 afterok:1:2:3\nnone afterok:4\n");
    const Outcome list = shell.run({"farm", "list", "scene.json", "--shares", "2500", "--max-running", "16"});
    CHECK(list.code == 2);
    CHECK(list.err.find("--max-running is for slurm") != std::string::npos);
}

TEST_CASE("where Slurm refuses a job, those submitted before it are cancelled") {
    const Shell shell;
    write_pretended_slurm(shell);
    write_text(shell.directory / "refuse_from", "3");
    CHECK(submit(shell, {"--shares", "5000"}) == 1);
    CHECK(bytes_of(shell.directory / "cancelled") == "1 2\n");
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
    // An sbatch that runs what it is given at once, task after task. No array may have more than four tasks.
    write_text(shell.directory / "farm.sh", farm("slurm"));
    write_text(shell.directory / "sbatch", R"(#!/bin/bash
cat >script
last=0 after=no
for word in "$@"; do
    case $word in --array=0-*) last=${word#--array=0-} ;; --dependency=afterok:*) after=yes ;; esac
done
echo "$last $after" >>submitted
for ((i = 0; i <= last; ++i)); do SLURM_ARRAY_TASK_ID=$i bash script >&2 || exit 1; done
echo 1
)");
    write_text(shell.directory / "scontrol", "#!/bin/sh\necho 'MaxArraySize = 4'\n");
    CHECK(run_by_shell(shell,
                       "chmod +x sbatch scontrol && rm beauty.exr && "
                       "PATH=$PWD:$PATH bash farm.sh >/dev/null 2>&1") == 0);
    CHECK(bytes_of(shell.directory / "submitted") == "3 no\n3 no\n0 no\n3 yes\n0 yes\n2 yes\n1 yes\n0 yes\n");
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

TEST_CASE(
    "a merge whose command line would be too long, and names that no file can have, are rejected when a farm is "
    "written") {
    const Shell shell;
    const std::string name(235, 's');
    write_text(shell.directory / "scene.json", cut_scene(6000));
    write_text(shell.directory / (name + ".json"), cut_scene(16'000'000));
    for (const char* const kind : {"slurm", "list"}) {
        CAPTURE(kind);
        // "p/scene.5999-6000.part " has 23 bytes.
        const Outcome wide =
            shell.run({"farm", kind, "scene.json", "--shares", "6000", "--merge-width", "6000", "--parts", "p"});
        CHECK_MESSAGE(wide.code == 2, wide.err);
        CHECK(wide.err.find("--merge-width 6000: the command line of a merge would have 13") != std::string::npos);
        CHECK(
            shell.run({"farm", kind, "scene.json", "--shares", "6000", "--merge-width", "5000", "--parts", "p"}).code ==
            0);
        const Outcome named = shell.run({"farm", kind, name + ".json", "--shares", "3", "-o", "a.exr"});
        CHECK(named.code == 2);
        CHECK(named.err.find("give the scene file a shorter name") != std::string::npos);
        CHECK(shell.run({"farm", kind, name + ".json", "--shares", "3", "-o", "a.exr", "--", "--spp", "9"}).code == 0);
    }
}

TEST_CASE("what makes no farm is rejected") {
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
    refused({"cloud", "scene.json", "--shares", "2"}, "must be slurm or list, but is \"cloud\"");
    refused({"list", "scene.json", "--shares", "5"}, "--shares 5: must be at most the number of samples per pixel, 4");
    refused({"list", "scene.json", "--shares", "2", "--", "--sample", "1"}, "options after -- are for render");
    refused({"list", "scene.json", "--shares", "2", "--", "--sample-range", "0:1"}, "are not allowed after --");
    refused({"list", "scene.json", "--shares", "2", "--", "--crop", "9,9,1,1"}, "--crop");
    refused({"list", "-", "--shares", "2"}, "must be a file");
    refused({"list", "scene.json", "--shares", "2", "--program", "a\nb"}, "must not contain newlines");
    refused({"list", "scene.json", "--shares", "2", "--merge-width", "1"}, "--merge-width");
    refused({"list", "scene.json", "--shares", "2", "--", "--denoise"}, "8 samples");
    refused({"list", "scene.json", "--shares", "2", "--", "--spp", "9", "--denoise=magic"}, "but is \"magic\"");
    refused({"list", "absent.json", "--shares", "2"}, "absent.json");
}

}  // namespace test_farm
