// Files of balls, by the reading of the nodes `balls` and `particles`: of what is read the search finds the ball that a
// loop over all of them would, and a box's list has it.
#include <bit>

#include "fuzz/input_file.hpp"
#include "phasetree/io/balls.hpp"
#include "phasetree/io/error.hpp"
#include "phasetree/math/float_mode.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/balls.hpp"
#include "phasetree/nodes/phased/particles.hpp"

namespace phasetree::fuzz {

namespace {

const std::filesystem::path& written(Bytes input) {
    static InputFile csv("balls.csv"), ply("balls.ply");
    return text_of(input).starts_with("ply") ? ply.write(input) : csv.write(input);
}

bool are_same(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

void look(const Balls& balls) {
    const float* data = balls.table.data();
    const FlushSubnormals flush;
    for (const float share : {-0.1f, 0.25f, 0.5f}) {
        const glm::vec3 at = balls.box.low + share * balls.box.extent();
        const Vec3<float> p{at.x, at.y, at.z};
        const float found = Balls::distance(data, p), looped = balls::ShortList::distance(data, p);
        promised(are_same(found, looped), "the nearest ball is found");
        PointRange range;
        for (std::size_t i = 0; i < 3; ++i) {
            range.centre[i] = static_cast<double>(at[static_cast<int>(i)]);
            range.reach[i] = 0.01 * static_cast<double>(balls.box.diagonal());
        }
        std::vector<float> few, required;
        if (Balls::specialise(data, range, {}, few)) {
            promised(Balls::Specialised::is_sound(few), "few balls are sound");
            promised(are_same(found, Balls::Specialised::distance(few.data(), p)), "the nearest ball is in the list");
        }
        if (Balls::specialise(data, range, 0, {}, required)) {
            const float local = Balls::Specialised::distance(required.data(), p);
            promised(found > 0 ? local > 0 : are_same(found, local), "a ball that is met is in the list");
        }
    }
}

}  // namespace

void run_balls(Bytes input) {
    try {
        FromFile<BallList> file{"balls", std::make_shared<const BallList>(read_balls(written(input)))};
        Balls balls{.file = file};
        if (file.content->radii.empty()) balls.radii = {0.5f};
        balls.prepare();
        look(balls);
        Particles particles{.of_phases = {Phase{1}, Phase{2}}, .radii = balls.radii, .file = file};
        particles.prepare();
    } catch (const SceneError&) {
    } catch (const ModelError&) {
    }
}

}  // namespace phasetree::fuzz
