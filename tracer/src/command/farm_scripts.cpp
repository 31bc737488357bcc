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

// The part of each share's command before the share's own arguments, and the part after them.
std::string render_head(const Farm& farm) {
    return words({farm.program, "render", farm.scene});
}
std::string render_tail(const Farm& farm) {
    return (farm.render_options.empty() ? "" : " ") + words(farm.render_options);
}

// The first of the shares that a part of this step consists of.
int first_share(const std::vector<int>& steps, std::size_t step, int part) {
    for (; step > 0; --step) part = static_cast<int>(std::int64_t{part} * steps[step - 1] / steps[step]);
    return part;
}

std::string part_name(const Farm& farm, int from_share, int to_share) {
    return fmt::format("{}.{}-{}.part", farm.parts, first_of_share(farm, from_share), first_of_share(farm, to_share));
}

std::string part_of_step(const Farm& farm, const std::vector<int>& steps, std::size_t step, int part) {
    return part_name(farm, first_share(steps, step, part), first_share(steps, step, part + 1));
}

// The command that merges the parts of the last step into the picture.
std::string last_merge(const Farm& farm, const std::vector<int>& steps) {
    std::vector<std::string> all{farm.program, "merge"};
    for (int i = 0; i < steps.back(); ++i) all.push_back(part_of_step(farm, steps, steps.size() - 1, i));
    for (const std::string& output : farm.outputs) {
        all.push_back("-o");
        all.push_back(output);
    }
    all.insert(all.end(), farm.merge_options.begin(), farm.merge_options.end());
    return words(all);
}

// One line per merge of a step other than the last.
std::string merges_of_step(const Farm& farm, const std::vector<int>& steps, std::size_t step) {
    std::string lines;
    for (int i = 0; i < steps[step]; ++i) {
        std::vector<std::string> all{farm.program, "merge"};
        const auto begin = [&](int part) {
            return static_cast<int>(std::int64_t{part} * steps[step - 1] / steps[step]);
        };
        for (int j = begin(i); j < begin(i + 1); ++j) all.push_back(part_of_step(farm, steps, step - 1, j));
        all.insert(all.end(), {"--quiet", "-o", part_of_step(farm, steps, step, i)});
        lines += words(all) + "\n";
    }
    return lines;
}

// The first sample of a part of this step, as an expression for bash.
std::string first_in_bash(const Farm& farm, const std::vector<int>& steps, std::size_t step, std::string part) {
    for (; step > 0; --step) part = fmt::format("({} * {} / {})", part, steps[step - 1], steps[step]);
    return fmt::format("{} * {} / {}", part, farm.samples, farm.shares);
}

// Submits the merges of a step other than the last.
std::string merges_in_bash(const Farm& farm, const std::vector<int>& steps, std::size_t step,
                           const std::string& options) {
    return fmt::format(
        R"bash(
# Merges neighbouring parts, so that no merge reads more than {most} parts.
merge_of_step_{step}() {{
    echo '#!/bin/bash'
    echo "i=\$(($1 + SLURM_ARRAY_TASK_ID)) parts=()"
    cat <<'END'
for ((j = i * {before} / {count}; j < (i + 1) * {before} / {count}; ++j)); do
    parts+=({parts}.$(({first}))-$(({next})).part)
done
exec {program} merge "${{parts[@]}}" --quiet -o {parts}.$(({whole_first}))-$(({whole_next})).part
END
}}
submit_arrays {count} merge_of_step_{step} --job-name=phasetree-merge --requeue{options}
)bash",
        fmt::arg("step", step), fmt::arg("options", options), fmt::arg("most", farm.most_parts),
        fmt::arg("before", steps[step - 1]), fmt::arg("count", steps[step]), fmt::arg("parts", shell_word(farm.parts)),
        fmt::arg("first", first_in_bash(farm, steps, step - 1, "j")),
        fmt::arg("next", first_in_bash(farm, steps, step - 1, "(j + 1)")),
        fmt::arg("program", shell_word(farm.program)), fmt::arg("whole_first", first_in_bash(farm, steps, step, "i")),
        fmt::arg("whole_next", first_in_bash(farm, steps, step, "(i + 1)")));
}

// Defines how the script submits jobs. `submit_arrays COUNT WRITER [OPTION…]` submits tasks 0 to COUNT - 1, which wait
// for the jobs in `jobs`. `WRITER FIRST` writes the script of the array that begins with task FIRST. Afterwards `jobs`
// has the ids of the new arrays, "1:2:3". If any submission fails, all jobs submitted so far are cancelled.
std::string submitting_in_bash(const Farm& farm) {
    return fmt::format(
        R"bash(submitted=() jobs=
trap 'code=$?; [ "$code" = 0 ] || [ ${{#submitted[@]}} = 0 ] || scancel "${{submitted[@]}}"; exit "$code"' EXIT

# An array's last index must be less than MaxArraySize, so longer ones are submitted in pieces.
longest=$(scontrol show config 2>/dev/null | sed -n 's/^MaxArraySize *= *\([0-9][0-9]*\).*/\1/p') || true
[ "${{longest:-0}}" -gt 0 ] || longest=1001
most_running={most_running}

# submit_arrays COUNT WRITER [OPTION...]: submits tasks 0 to COUNT - 1, which wait for `jobs`, and sets `jobs` to their arrays.
# "WRITER FIRST" writes the script of the array whose first task is FIRST.
submit_arrays() {{
    local count=$1 writer=$2 before=$jobs first size job dependency
    shift 2
    jobs=
    for ((first = 0; first < count; first += longest)); do
        size=$((count - first < longest ? count - first : longest))
        dependency=${{before:+afterok:$before}}
        # %N limits one array, so with a limit each array waits until the one before it has ended.
        if [ "$most_running" -gt 0 ] && [ -n "$jobs" ]; then
            dependency=${{dependency:+$dependency,}}afterany:${{jobs##*:}}
        fi
        job=$("$writer" "$first" | sbatch --parsable --array=0-$((size - 1)){limit} ${{dependency:+--dependency="$dependency"}} "$@")
        job=${{job%%;*}}
        submitted+=("$job")
        jobs=${{jobs:+$jobs:}}$job
    done
}}
)bash",
        fmt::arg("most_running", farm.most_running),
        fmt::arg("limit", farm.most_running > 0 ? fmt::format("%{}", farm.most_running) : ""));
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
    return part_name(farm, share, share + 1);
}

std::vector<int> parts_of_steps(const Farm& farm) {
    std::vector<int> steps{farm.shares};
    while (steps.back() > farm.most_parts) steps.push_back((steps.back() + farm.most_parts - 1) / farm.most_parts);
    return steps;
}

std::size_t longest_merge_line(const Farm& farm) {
    // The last share has the largest numbers, so its part has the longest name.
    const std::size_t part = shell_word(part_of_share(farm, farm.shares - 1)).size() + 1;
    std::size_t bytes = words({farm.program, "merge", "--quiet", "-o"}).size() + part;
    for (const std::string& word : farm.outputs) bytes += shell_word(word).size() + std::string_view(" -o ").size();
    for (const std::string& word : farm.merge_options) bytes += shell_word(word).size() + 1;
    return bytes + part * static_cast<std::size_t>(std::min(farm.shares, farm.most_parts));
}

std::string command_list(const Farm& farm) {
    std::string list;
    for (int i = 0; i < farm.shares; ++i) {
        const std::string part = shell_word(part_of_share(farm, i));
        list +=
            fmt::format("{} --sample-range {}:{} --checkpoint {} --resume {} --or-start -o {}{}\n", render_head(farm),
                        first_of_share(farm, i), first_of_share(farm, i + 1), part, part, part, render_tail(farm));
    }
    const std::vector<int> steps = parts_of_steps(farm);
    for (std::size_t step = 1; step < steps.size(); ++step) list += merges_of_step(farm, steps, step);
    return list + last_merge(farm, steps) + "\n";
}

std::string slurm_script(const Farm& farm) {
    const std::string options = (farm.sbatch_options.empty() ? "" : " ") + words(farm.sbatch_options);
    const std::vector<int> steps = parts_of_steps(farm);
    std::string steps_between;
    for (std::size_t step = 1; step < steps.size(); ++step) steps_between += merges_in_bash(farm, steps, step, options);
    return fmt::format(
        R"bash(#!/bin/bash
# Run this on a machine with sbatch. It submits {shares} shares of {samples} samples per pixel and the merges that wait for them. It
# prints the number of the last job, which makes the picture.
set -eu
{submitting}
# A share that is preempted, requeued or near its time limit resumes where it stopped. Slurm may send SIGTERM to this script
# alone or to all of its processes. So the render ignores SIGTERM, and the script sends it one SIGHUP instead.
share() {{
    echo '#!/bin/bash'
    echo "share=\$(($1 + SLURM_ARRAY_TASK_ID))"
    cat <<'END'
first=$((share * {samples} / {shares})) last=$(((share + 1) * {samples} / {shares}))
part={parts}.$first-$last.part
is_stopped=no
stop() {{
    trap '' TERM
    is_stopped=yes
    kill -HUP "$render"
}}
(trap '' TERM; exec {head} --sample-range "$first:$last" --checkpoint "$part" --resume "$part" --or-start -o "$part"{tail}{threads}) &
render=$!
trap stop TERM
code=0
wait "$render" || code=$?
if [ "$is_stopped" = yes ]; then
    code=0
    wait "$render" || code=$?
fi
# 75: there is a checkpoint to resume. Above 128: a signal came before the first checkpoint, or another signal did, such as the
# system's when memory runs out; then the share is tried again, up to three times.
if [ "$code" = 75 ] || {{ [ "$code" -gt 128 ] && {{ [ "$is_stopped" = yes ] || [ "${{SLURM_RESTART_COUNT:-0}}" -lt 3 ]; }}; }}; then
    scontrol requeue "${{SLURM_ARRAY_JOB_ID}}_$SLURM_ARRAY_TASK_ID"
fi
exit "$code"
END
}}
submit_arrays {shares} share --job-name=phasetree --requeue --open-mode=append --signal=B:TERM@60{options}
{between}
last=$(sbatch --parsable --job-name=phasetree-merge --dependency="afterok:$jobs"{options} <<'END'
#!/bin/bash
exec {merge}
END
)
submitted=()
echo "$last"
)bash",
        fmt::arg("shares", farm.shares), fmt::arg("samples", farm.samples), fmt::arg("options", options),
        fmt::arg("submitting", submitting_in_bash(farm)), fmt::arg("parts", shell_word(farm.parts)),
        fmt::arg("head", render_head(farm)), fmt::arg("tail", render_tail(farm)),
        fmt::arg("threads", farm.has_threads ? "" : R"( ${SLURM_CPUS_PER_TASK:+--threads "$SLURM_CPUS_PER_TASK"})"),
        fmt::arg("between", steps_between), fmt::arg("merge", last_merge(farm, steps)));
}

}  // namespace phasetree::tracer
