// A render as many: a script for Slurm, or one command a line for any other queue. These are texts; phasetree starts
// and watches nothing.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace phasetree::tracer {

struct Farm {
    std::string program;                      // the command, as the machines of the farm find it
    std::string scene;                        // its file
    std::vector<std::string> render_options;  // of every share
    bool has_threads = false;                 // whether they say how many threads it has
    std::vector<std::string> outputs;         // of the merge
    std::vector<std::string> merge_options;
    std::string parts;  // the beginning of the parts' names
    std::vector<std::string> sbatch_options;
    int most_running = 0;         // shares, or merges, that Slurm runs at a time; 0 for any number
    int samples = 1, shares = 1;  // samples a pixel, divided among so many
    int most_parts = 64;          // that one merge reads, at least 2; more shares are merged in steps
};

// A word as a shell reads it, whatever is in it.
std::string shell_word(const std::string& word);

// Share i has the samples from i·samples/shares on, rounded down, up to where the next begins.
int first_of_share(const Farm& farm, int share);
std::string part_of_share(const Farm& farm, int share);

// How many parts there are at each step: first the shares, then those that merges of neighbours leave, until one merge
// can read all. Merge i of n has the parts from i·m/n on, rounded down, of the m before.
std::vector<int> parts_of_steps(const Farm& farm);

// At least as many bytes as the longest command line of a merge has.
std::size_t longest_merge_line(const Farm& farm);

// The commands of the shares, then those of each step of merging, the picture's last.
std::string command_list(const Farm& farm);
// A script for bash that submits the shares, then each step of merging, and last the job that makes the picture; each
// waits for those before it. Shares and merges are job arrays, as many as Slurm's limit on the length of an array
// (MaxArraySize) demands.
std::string slurm_script(const Farm& farm);

}  // namespace phasetree::tracer
