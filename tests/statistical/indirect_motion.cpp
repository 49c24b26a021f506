// Indirect light while things move: lamps that grow and shrink, reflectors that turn and grow, blinds that
// come between a place and its lamp or go away. Weights that trace visibility have the reference's mean at
// that very moment, and the mistakes of motion are found. TARN_TEST_SEEDS=N takes N seeds.
#include "motion_run.h"
#include "support/indirect_scenes.h"

namespace tarn::test {
namespace {

// A picture of indirect light alone is noisy, in its dark corners above all. Mistakes of motion are large in
// these rooms: few seeds show them.
constexpr Power POWER{0.03, 0.3};
constexpr int SEEDS_FOR_POWER = 40;
constexpr int SEEDS_TO_FIND_A_BUG = 16;

class IndirectMotion : public MotionTest {
  protected:
    static void expect_no_bias(const MovingScene& moving, const std::vector<MotionMethod>& methods) {
        const char* asked = std::getenv("TARN_TEST_SEEDS");
        MotionTest::expect_no_bias(moving, methods, asked ? std::max(8, std::atoi(asked)) : SEEDS_FOR_POWER,
                                   POWER);
    }

    static void expect_found(const MovingScene& moving, const MotionMethod& method,
                             const std::string& planted) {
        MotionTest::expect_found(moving, method, planted, SEEDS_TO_FIND_A_BUG);
    }

    // Path samples reused without bias. Direct light keeps no history, and a long one of paths shows its
    // faults.
    static MotionMethod paths(const std::string& name, Mis mis = Mis::PAIRWISE, int bounces = 1) {
        RenderSettings settings = find_preset("unbiased").settings;
        settings.direct.mode = DirectMode::RIS;
        settings.indirect.mode = IndirectMode::RESTIR;
        settings.indirect.bounces = bounces;
        settings.indirect.reuse.mis = mis;
        settings.indirect.reuse.radius_px = 10.0;  // of a small picture
        settings.indirect.reuse.motion_cap = settings.indirect.reuse.confidence_cap;
        return {name, [settings](int) { return settings; }};
    }

    static std::vector<MotionMethod> both() { return {paths("pairwise"), paths("balance", Mis::BALANCE)}; }
};

TEST_F(IndirectMotion, LampsThatGrow) {
    expect_no_bias(make_breathing_uplight(0.05), both());
}

TEST_F(IndirectMotion, LampsThatShrink) {
    expect_no_bias(make_breathing_uplight(-0.05), both());
}

TEST_F(IndirectMotion, NegativeControlLampsWhoseChangeIsForgottenAreFound) {
    for (const char* planted : {"TARN_PLANT_DROP_LAMP_AREA", "TARN_PLANT_STALE_LIGHT"}) {
        expect_found(make_breathing_uplight(0.05), paths("pairwise"), planted);
        expect_found(make_breathing_uplight(-0.05), paths("balance", Mis::BALANCE), planted);
    }
}

TEST_F(IndirectMotion, ReflectorsThatTurn) {
    expect_no_bias(make_moving_reflector(0.0, 0.06), both());
}

TEST_F(IndirectMotion, ReflectorsThatGrowOrShrink) {
    expect_no_bias(make_moving_reflector(0.06, 0.0), both());
    expect_no_bias(make_moving_reflector(-0.06, 0.0), both());
}

TEST_F(IndirectMotion, NegativeControlPlacesThatDoNotFollowTheirThingAreFound) {
    for (const char* planted : {"TARN_PLANT_STAY_BEHIND", "TARN_PLANT_KEEP_PATH_NORMAL"}) {
        expect_found(make_moving_reflector(0.0, 0.06), paths("pairwise"), planted);
    }
    expect_found(make_moving_reflector(0.06, 0.0), paths("pairwise"), "TARN_PLANT_DROP_AREA_RATIO");
    expect_found(make_moving_reflector(-0.06, 0.0), paths("balance", Mis::BALANCE),
                 "TARN_PLANT_DROP_AREA_RATIO");
}

TEST_F(IndirectMotion, BlindsThatComeBetweenAPlaceAndItsLamp) {
    expect_no_bias(make_sliding_blind(0.06), both());
}

TEST_F(IndirectMotion, BlindsThatGoAway) {
    expect_no_bias(make_sliding_blind(-0.06), both());
}

TEST_F(IndirectMotion, BlindsBetweenAPlaceAndTheSky) {
    expect_no_bias(make_sliding_blind(0.2, true), both());
}

TEST_F(IndirectMotion, NegativeControlBlindsThatAreNotNoticedAreFound) {
    const char* planted = "TARN_PLANT_TRUST_CARRIED_LIGHT";
    expect_found(make_sliding_blind(0.06), paths("pairwise"), planted);
    expect_found(make_sliding_blind(-0.06), paths("balance", Mis::BALANCE), planted);
    expect_found(make_sliding_blind(0.2, true), paths("pairwise"), planted);
}

TEST_F(IndirectMotion, EverythingAtOnceWithOneAndThreeBounces) {
    expect_no_bias(make_restless_room(), both());
    expect_no_bias(make_restless_room(), {paths("pairwise, 3 bounces", Mis::PAIRWISE, 3)});
}

}  // namespace
}  // namespace tarn::test
