#include "command/farm_scripts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

namespace phasetree::tracer {

namespace {

bool is_plain(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("-_./:,=+@%").find(c) != std::string_view::npos;
}

std::string words(const std::vector<std::string>& all) {
    std::string line;
    for (const std::string& word : all) line += (line.empty() ? "" : " ") + shell_word(word);
    return line;
}

// What comes before the share's own words in each of its commands, and what after them.
std::string render_head(const Farm& farm) {
    return words({farm.program, "render", farm.scene});
}
std::string render_tail(const Farm& farm) {
    return (farm.render_options.empty() ? "" : " ") + words(farm.render_options);
}

std::string merge_command(const Farm& farm) {
    std::vector<std::string> all{farm.program, "merge"};
    for (int i = 0; i < farm.shares; ++i) all.push_back(part_of_share(farm, i));
    for (const std::string& output : farm.outputs) {
        all.push_back("-o");
        all.push_back(output);
    }
    all.insert(all.end(), farm.merge_options.begin(), farm.merge_options.end());
    return words(all);
}

}  // namespace

std::string shell_word(const std::string& word) {
    if (!word.empty() && std::ranges::all_of(word, is_plain)) return word;
    std::string quoted = "'";
    for (const char c : word) {
        if (c == '\'')
            quoted += "'\\''";
        else
            quoted += c;
    }
    return quoted + "'";
}

int first_of_share(const Farm& farm, int share) {
    return static_cast<int>(std::int64_t{farm.samples} * share / farm.shares);
}

std::string part_of_share(const Farm& farm, int share) {
    return fmt::format("{}.{}-{}.part", farm.parts, first_of_share(farm, share), first_of_share(farm, share + 1));
}

std::string command_list(const Farm& farm) {
    std::string list;
    for (int i = 0; i < farm.shares; ++i) {
        const std::string part = shell_word(part_of_share(farm, i));
        list += fmt::format("{} --samples {}:{} --checkpoint {} --resume {} --or-start -o {}{}\n", render_head(farm),
                            first_of_share(farm, i), first_of_share(farm, i + 1), part, part, part, render_tail(farm));
    }
    return list + merge_command(farm) + "\n";
}

std::string slurm_script(const Farm& farm) {
    const std::string options = (farm.sbatch_options.empty() ? "" : " ") + words(farm.sbatch_options);
    return fmt::format(
        R"(#!/bin/bash
# Run by hand where sbatch is: submits {shares} shares of {samples} samples a pixel as an array, and a job that merges them
# when all are done. Prints the number of that job.
set -eu
array=$(sbatch --parsable --job-name=phasetree --array=0-{last} --requeue --open-mode=append --signal=B:TERM@60{options} <<'END'
#!/bin/bash
# A share goes on from where it was when it was preempted, requeued or near its time limit. Slurm may send SIGTERM to this
# script alone or to all of its processes. So the render ignores that, and is told once, by SIGHUP.
first=$((SLURM_ARRAY_TASK_ID * {samples} / {shares})) last=$(((SLURM_ARRAY_TASK_ID + 1) * {samples} / {shares}))
part={parts}.$first-$last.part
is_stopped=no
stop() {{
    trap '' TERM
    is_stopped=yes
    kill -HUP "$render"
}}
(trap '' TERM; exec {head} --samples "$first:$last" --checkpoint "$part" --resume "$part" --or-start -o "$part"{tail}{threads}) &
render=$!
trap stop TERM
code=0
wait "$render" || code=$?
if [ "$is_stopped" = yes ]; then
    code=0
    wait "$render" || code=$?
fi
# 75: there is a checkpoint to go on from. Above 128: a signal came too early for one, or was another, such as the system's
# when memory runs out, after which it is tried again three times.
if [ "$code" = 75 ] || {{ [ "$code" -gt 128 ] && {{ [ "$is_stopped" = yes ] || [ "${{SLURM_RESTART_COUNT:-0}}" -lt 3 ]; }}; }}; then
    scontrol requeue "${{SLURM_ARRAY_JOB_ID}}_$SLURM_ARRAY_TASK_ID"
fi
exit "$code"
END
)
sbatch --parsable --job-name=phasetree-merge --dependency="afterok:$array"{options} <<'END'
#!/bin/bash
exec {merge}
END
)",
        fmt::arg("shares", farm.shares), fmt::arg("samples", farm.samples), fmt::arg("last", farm.shares - 1),
        fmt::arg("options", options), fmt::arg("parts", shell_word(farm.parts)), fmt::arg("head", render_head(farm)),
        fmt::arg("tail", render_tail(farm)),
        fmt::arg("threads", farm.has_threads ? "" : R"( ${SLURM_CPUS_PER_TASK:+--threads "$SLURM_CPUS_PER_TASK"})"),
        fmt::arg("merge", merge_command(farm)));
}

}  // namespace phasetree::tracer
