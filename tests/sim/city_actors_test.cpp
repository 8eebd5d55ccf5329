// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <map>

#include "sim/city.hpp"

namespace dynamic_filter::sim::city {
namespace city_actors_test {

Eigen::Vector2d position(const Ride& ride, double t) {
    return at(ride.path, travelled(ride, t)).position;
}

/// Discs that cover an actor.
std::vector<Mover> discs(const Actor& actor, double t) {
    std::vector<Mover> out;
    if (actor.on_foot) {
        out.push_back({position(actor.vehicle.ride, t), Eigen::Vector2d::Zero(), 0.2});
    } else {
        add_movers(actor.vehicle, t, out);
    }
    return out;
}

const Route& way() {
    static const Route made = route(1, 1.0, 1);
    return made;
}

const std::vector<Actor>& people_and_traffic() {
    static const std::vector<Actor> made = actors(1, way(), 14, 1);
    return made;
}

TEST(CityActors, AllKindsAreThereAndMostMove) {
    std::map<VehicleKind, int> kinds;
    int walking = 0, standing = 0;
    for (const Actor& actor : people_and_traffic()) {
        if (!actor.on_foot) {
            ++kinds[actor.vehicle.kind];
        } else {
            (actor.vehicle.ride.speed > 0.0 ? walking : standing) += 1;
        }
    }
    EXPECT_GT(kinds[VehicleKind::car], 20);
    EXPECT_GT(kinds[VehicleKind::cyclist], 10);
    EXPECT_GT(kinds[VehicleKind::van], 2);
    EXPECT_GT(walking, 60);
    EXPECT_GT(standing, 3);
}

TEST(CityActors, NoneMeetsTheVehicleOrAnother) {
    const auto& all = people_and_traffic();
    for (double t = 0.0; t < way().duration; t += 0.4) {
        std::vector<std::vector<Mover>> here = {
            {{position(way().ride, t), Eigen::Vector2d::Zero(), 1.0}}};
        for (const Actor& actor : all) {
            if (t >= actor.from && t <= actor.until) here.push_back(discs(actor, t));
        }
        for (std::size_t i = 0; i < here.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                for (const Mover& a : here[i]) {
                    for (const Mover& b : here[j])
                        ASSERT_GT((a.centre - b.centre).norm(), a.radius + b.radius) << t;
                }
            }
        }
    }
}

TEST(CityActors, TheyComeAndGoOutOfSight) {
    for (const Actor& actor : people_and_traffic()) {
        EXPECT_LT(actor.from, actor.until);
        for (const double t : {actor.from, actor.until}) {
            const double away = (position(actor.vehicle.ride, t) - position(way().ride, t)).norm();
            EXPECT_GT(away, 100.0);
        }
    }
}

TEST(CityActors, VehiclesKeepToTheStreetAndStandingPeopleToThePavement) {
    for (const Actor& actor : people_and_traffic()) {
        const double t = 0.5 * (actor.from + actor.until);
        const Eigen::Vector2d p = position(actor.vehicle.ride, t);
        const bool stands = actor.on_foot && actor.vehicle.ride.speed == 0.0;
        if (actor.on_foot && !stands) continue;
        EXPECT_DOUBLE_EQ(ground(p), stands ? pavement : 0.0);
    }
}

TEST(CityActors, LegsMoveWhileSomebodyWalks) {
    for (const Actor& actor : people_and_traffic()) {
        if (!actor.on_foot) continue;
        const Stride stride = stride_of(actor, actor.from);
        EXPECT_NEAR(stride.heading.norm(), 1.0F, 1e-5F);
        EXPECT_EQ(stride.swing > 0.0F, stride.speed >= 0.12F);
        EXPECT_LT(stride.speed, 1.7F);
    }
}

}  // namespace city_actors_test
}  // namespace dynamic_filter::sim::city
