// A target for libFuzzer: fuzz --target=NAME [libFuzzer's arguments, folders of inputs]; fuzz --words prints its
// dictionary.
#include <oneapi/tbb/global_control.h>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>

#include "fuzz/mutate.hpp"
#include "fuzz/words.hpp"

using namespace phasetree::fuzz;

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace {

// libFuzzer's interface has no room for a context.
const Target* chosen = nullptr;

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
    // One thread: an input does the same each time.
    static const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    for (int i = 1; i < *count; ++i) {
        const std::string_view argument = (*arguments)[i];
        if (argument == "--words") {
            for (const std::string& word : words()) std::printf("\"\\\"%s\\\"\"\n", word.c_str());
            std::exit(0);
        }
        if (argument == "--targets") {
            for (const Target& t : targets())
                std::printf("%s %zu %s\n", std::string(t.name).c_str(), t.longest, std::string(t.seeds).c_str());
            std::exit(0);
        }
        if (argument.starts_with("--target=")) chosen = &target(argument.substr(9));
    }
    if (!chosen) {
        std::fprintf(stderr, "--target=NAME is missing\n");
        std::exit(2);
    }
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    chosen->run({data, size});
    return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
    static const std::vector<std::string> known = words();
    Random random(seed);
    if (chosen->inputs == Inputs::bytes || random.below(3) == 0) return LLVMFuzzerMutate(data, size, most);
    std::string text(reinterpret_cast<const char*>(data), size);
    for (std::size_t i = random.below(3) + 1; i-- > 0;) text = mutated(text, chosen->inputs, known, random);
    const std::size_t length = std::min(text.size(), most);
    std::memcpy(data, text.data(), length);
    return length;
}
