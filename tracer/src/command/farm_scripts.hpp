// Distributed rendering: a script for Slurm, or a list of commands, one per line, for any other queue. This only
// generates text; phasetree neither starts nor monitors jobs.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace phasetree::tracer {

struct Farm {
    std::string program;                      // the phasetree command on the machines of the farm
    std::string scene;                        // the scene file
    std::vector<std::string> render_options;  // for every share
    bool has_threads = false;                 // whether the options set the number of threads
    std::vector<std::string> outputs;         // of the merge
    std::vector<std::string> merge_options;
    std::string parts;  // prefix of the parts' file names
    std::vector<std::string> sbatch_options;
    int most_running = 0;         // maximum number of shares, or merges, that Slurm runs at once; 0 for no limit
    int samples = 1, shares = 1;  // samples per pixel, and the number of shares that they are divided into
    int most_parts = 64;          // maximum number of parts per merge, at least 2; more are merged in several steps
};

// Quotes any text as one word for a shell.
std::string shell_word(const std::string& word);

// The first sample of a share. Share i has the samples from i·samples/shares, rounded down, to the first of the next
// share.
int first_of_share(const Farm& farm, int share);
std::string part_of_share(const Farm& farm, int share);

// The number of parts at each step: first the shares, then the results of merging neighbours, until a single merge can
// read them all. If the previous step has m parts, merge i of n reads those from i·m/n on, rounded down.
std::vector<int> parts_of_steps(const Farm& farm);

// An upper bound on the length in bytes of a merge's command line.
std::size_t longest_merge_line(const Farm& farm);

// The commands of the shares, then those of each merging step. The last one makes the picture.
std::string command_list(const Farm& farm);
// A bash script that submits the shares, then each merging step, and finally the job that makes the picture. Each waits
// for the jobs before it. Shares and merges are job arrays, split as Slurm's limit on their length (MaxArraySize)
// requires.
std::string slurm_script(const Farm& farm);

}  // namespace phasetree::tracer
