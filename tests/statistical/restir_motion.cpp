// ReSTIR while solid things move. The modes called unbiased have the reference's mean at that very moment,
// the presets stay within the bounds that they state, and the mistakes of motion are found.
#include "motion_run.h"

namespace tarn::test {
namespace {

class RestirMotion : public MotionTest {};

const Material MATT = lambert_material(glm::vec3(0.7f, 0.6f, 0.5f));
const Material GLOSSY = glossy_material(glm::vec3(0.6f), 0.3f);

TEST_F(RestirMotion, ThingsThatCreep) {
    expect_no_bias(make_moving_things(0.005, MATT), unbiased_methods());
    expect_within_bounds(make_moving_things(0.005, MATT));
}

TEST_F(RestirMotion, ThingsThatWalk) {
    expect_no_bias(make_moving_things(0.02, GLOSSY), unbiased_methods());
    expect_within_bounds(make_moving_things(0.02, GLOSSY));
}

// What races leaves its history behind, and the picture is noisier.
TEST_F(RestirMotion, ThingsThatRacePairwise) {
    expect_no_bias(make_moving_things(0.2, MATT), {unbiased("pairwise")}, 3 * SEEDS);
    expect_within_bounds(make_moving_things(0.2, MATT));
}

TEST_F(RestirMotion, ThingsThatRaceBalance) {
    expect_no_bias(make_moving_things(0.2, MATT), {unbiased("balance", Mis::BALANCE)}, 5 * SEEDS);
}

TEST_F(RestirMotion, NegativeControlRaysOfTheLastFrameInPresentGeometryAreFound) {
    expect_found(make_moving_things(0.005, MATT), unbiased("pairwise"), "TARN_PLANT_PRESENT_GEOMETRY");
}

// 1/Z weighs all alike that could have drawn a sample, and is the noisiest.
TEST_F(RestirMotion, LampsThatGrowOrCircleByCount) {
    const MotionMethod count = unbiased("count", Mis::ONE_OVER_Z);
    expect_no_bias(make_breathing_lamp(0.1), {count}, 3 * SEEDS);
    expect_no_bias(make_many_lamps(0.02), {count}, 4 * SEEDS);
}

TEST_F(RestirMotion, LampsThatGrow) {
    expect_no_bias(make_breathing_lamp(0.1), unbiased_methods(), 2 * SEEDS);
    expect_within_bounds(make_breathing_lamp(0.1));
}

TEST_F(RestirMotion, LampsThatShrink) {
    expect_no_bias(make_breathing_lamp(-0.05), unbiased_methods(), 2 * SEEDS);
    expect_within_bounds(make_breathing_lamp(-0.05));
}

TEST_F(RestirMotion, NegativeControlJacobiansThatAreDroppedAreFound) {
    for (const char* planted : {"TARN_PLANT_DROP_FRESH_JACOBIAN", "TARN_PLANT_DROP_PREVIOUS_JACOBIAN"}) {
        expect_found(make_breathing_lamp(0.1), unbiased("pairwise"), planted);
        expect_found(make_breathing_lamp(-0.05), unbiased("balance", Mis::BALANCE), planted);
    }
}

TEST_F(RestirMotion, ThingsThatMorphAndBend) {
    expect_no_bias(make_deforming_things(), unbiased_methods());
    expect_within_bounds(make_deforming_things());
}

TEST_F(RestirMotion, VeilsAndLampsThatFadePairwise) {
    expect_no_bias(make_fading_veils(), {unbiased("pairwise")}, 4 * SEEDS);
    expect_within_bounds(make_fading_veils());
}

TEST_F(RestirMotion, VeilsAndLampsThatFadeBalance) {
    expect_no_bias(make_fading_veils(), {unbiased("balance", Mis::BALANCE)}, 5 * SEEDS);
}

TEST_F(RestirMotion, LampsWithTexturesAndMirroredOnes) {
    expect_no_bias(make_textured_lamps(), unbiased_methods(), 2 * SEEDS);
    expect_within_bounds(make_textured_lamps());
}

TEST_F(RestirMotion, ManyLampsInColour) {
    expect_no_bias(make_many_lamps(0.02), unbiased_methods(), 2 * SEEDS);
    expect_within_bounds(make_many_lamps(0.02));
}

TEST_F(RestirMotion, ASampleForEachChannel) {
    const auto per_channel = [](RenderSettings& settings) { settings.direct.per_channel = true; };
    expect_no_bias(make_many_lamps(0.02), {unbiased("pairwise, per channel", Mis::PAIRWISE, per_channel)});
}

// Whatever wrote the frames before, what follows has no bias.
TEST_F(RestirMotion, MethodsThatTakeTurns) {
    const RenderSettings last = unbiased("").settings(LAST_FRAME);
    const auto turns = [&](const char* other, int from, int to) {
        RenderSettings between = find_preset("balanced").settings;
        if (other == std::string("ris")) between.direct.mode = DirectMode::RIS;
        if (other == std::string("student")) between = find_preset("student").settings;
        return MotionMethod{fmt::format("{} in frames {} to {}", other, from, to),
                            [=](int frame) { return frame >= from && frame <= to ? between : last; },
                            {},
                            true};
    };
    expect_no_bias(
        make_moving_things(0.02, MATT),
        {turns("balanced", 0, LAST_FRAME - 2), turns("ris", 2, 4), turns("student", 0, LAST_FRAME - 1)},
        2 * SEEDS);
}

}  // namespace
}  // namespace tarn::test
