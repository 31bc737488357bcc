// Files of balls, by the reading of the nodes `balls` and `particles`: of what is read the search finds the ball that a
// loop over all of them would, and a box's list has it.
#include "phasetree/io/balls.hpp"
#include "fuzz/found_by_search.hpp"
#include "fuzz/input_file.hpp"
#include "phasetree/io/error.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/balls.hpp"
#include "phasetree/nodes/phased/particles.hpp"

namespace phasetree::fuzz {

namespace {

const std::filesystem::path& balls_file(Bytes input) {
    static InputFile csv("balls.csv"), ply("balls.ply");
    return text_of(input).starts_with("ply") ? ply.write(input) : csv.write(input);
}

void look(const Balls& balls) {
    promise_search<balls::ShortList>(balls, [&](const PointRange& range, const Vec3<float>& p, float found) {
        std::vector<float> required;
        if (!Balls::specialise(balls.table.data(), range, 0, {}, required)) return;
        const float local = Balls::Specialised::distance(required.data(), p);
        promised(found > 0 ? local > 0 : are_same(found, local), "a ball that is met is in the list");
    });
}

}  // namespace

void run_balls(Bytes input) {
    try {
        FromFile<BallList> file{"balls", std::make_shared<const BallList>(read_balls(balls_file(input)))};
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
