#include "model/preparation.hpp"

#include <doctest/doctest.h>

#include "phasetree/model/handle.hpp"

namespace test_preparation {

using namespace phasetree;

using model::Preparation, model::PreparationTogether;

TEST_CASE("a node, and all nodes of a scene together, may do so much work and no more") {
    Preparation alone("a");
    alone.pay(Preparation::most);
    CHECK(alone.left() == 0);
    CHECK_THROWS_AS(alone.pay(1), ModelError);

    const PreparationTogether scene;
    for (std::uint64_t i = 0; i < PreparationTogether::most / Preparation::most; ++i)
        Preparation("b").pay(Preparation::most);
    CHECK_THROWS_WITH_AS(Preparation("c").pay(1),
                         "c: preparing this node and those before it exceeds the limit of 4000 million steps per scene",
                         ModelError);
    {
        const PreparationTogether another;
        Preparation("d").pay(Preparation::most);
    }
    CHECK_THROWS_AS(Preparation("e").pay(1), ModelError);
}

TEST_CASE("work in proportion to a file is granted once for each content") {
    const int one = 0, other = 0;
    Preparation alone("a", &one, 100);
    CHECK(alone.left() == Preparation::most + 100);
    PreparationTogether scene;
    Preparation("a", &one, 100).pay(80);
    CHECK(scene.paid() == 0);
    Preparation("b", &one, 100).pay(80);
    CHECK(scene.paid() == 60);
    Preparation("c", &other, 100).pay(150);
    CHECK(scene.paid() == 110);
}

}  // namespace test_preparation
