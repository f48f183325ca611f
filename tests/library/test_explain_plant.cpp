// SPDX-License-Identifier: MIT
//
// The promise: swivel_explain() says of a planted limb why it stands or slides, what the ground does to a foot, and
// where a shift goes, in the words of approved/feet.txt. It warns of other units and origins, and names bad input. The
// animation and the places of targets confirm its numbers.
#include "tests/approved_texts.h"
#include "tests/gliding_leg.h"

using namespace swivel;
using namespace swivel::test;

namespace {

constexpr swivel_features kPlants = GlidingLeg::kPlants, kStands = GlidingLeg::kStands;
constexpr Float3 kToe{0, -0.07f, 0.13f}, kHeel{0, -0.07f, -0.05f};  // in the foot's frame

swivel_ground sole()
{
    swivel_ground ground = swivel_default_ground();
    std::copy(kHeel.begin(), kHeel.end(), ground.heel);
    return ground;
}
Quaterniond turned(double angle, const Vector3d& axis) { return Quaterniond(Eigen::AngleAxisd(angle, axis)); }

// A leg that is told of. Its foot is level at first.
struct ToldLeg : GlidingLeg {
    ApprovedTexts& texts;
    Quaterniond foot = Quaterniond::Identity();  // as animated

    ToldLeg(ApprovedTexts& approved, const std::string& scene, swivel_features features = kPlants,
            const swivel_plant& plant = swivel_default_plant(), const swivel_ground& ground = sole())
        : GlidingLeg(features, plant, ground), texts(approved)
    {
        texts.scene(scene);
        if (features & SWIVEL_WITH_EFFECTOR) crowd.write_all(SWIVEL_EFFECTOR, 0, kToe);
        turn_foot(foot);
    }
    void says(const std::string& when, std::uint32_t group = 0) { texts.line(when, text(group)); }
    template <class Value>
    void write(swivel_field field, const Value& value, std::uint32_t group = 0)
    {
        crowd.write_all(field, group, value);
    }
    void turn_foot(const Quaterniond& turn)
    {
        foot = turn;
        rotations[3] = floats(Quaterniond((quat(rotations[1]) * quat(rotations[2])).conjugate() * turn));
    }
    Vector3d toe() const { return animated() + foot * vec(kToe); }
    // Ground of a slope below the toe, which is `over` above it.
    void stand(double over, double slope, const Vector3d& axis = Vector3d::UnitX())
    {
        write(SWIVEL_GROUND, floats(Vector3d(toe() - over * Vector3d::UnitY())));
        write(SWIVEL_GROUND_NORMAL, floats(Vector3d(turned(slope, axis) * Vector3d::UnitY())));
    }
};

void tell_of_contact(ApprovedTexts& texts)
{
    ToldLeg leg(texts, "a foot runs in, and then it stands");
    leg.glide(0, 0.5, 3);
    leg.glide(1, 0.5), leg.says("locks");
    std::vector<std::string> run_in = {leg.text()};
    for (int n = 1; n < 9; ++n) leg.glide(1, 0), run_in.push_back(leg.text());
    texts.line("40 ms later", run_in[2]), leg.says("stands");
    for (std::size_t n = 0; n < 5; ++n) {
        const double since = 1000 * double{GlidingLeg::kFrame} * static_cast<double>(n);
        CHECK(number_after(run_in[n], "it locked ") == Approx(since));
        CHECK(number_after(run_in[n], "comes to rest in ") == Approx(100 - since));
        CHECK(number_after(run_in[n], " ms, ") == Approx((leg.sent[3 + n] - leg.sent.back()).norm()).epsilon(6e-4));
    }
    leg.write(SWIVEL_CONTACT, std::array{0.4f}), leg.says("another label");

    ToldLeg free(texts, "why a foot is not locked");
    free.glide(0.3f, 0.5, 3), free.says("its label");
    free.write(SWIVEL_CONTACT, std::array{0.9f}), free.says("another label");
    free.glide(0.9f, 8, 3), free.says("fast");
    free.glide(0.9f, 0, 20);
    CHECK(swivel_reset(free.crowd.get(), 0, 0, 1) == SWIVEL_OK);
    free.says("reset");

    swivel_plant low = plant_with(&swivel_plant::relock_speed, 0.07f);
    low.speed[0] = 0.55f, low.height[0] = 0.45f, low.height[1] = 0.5f;  // the ankle is 0.14 over the root
    ToldLeg moves(texts, "contact by motion", kPlants | SWIVEL_PLANT_BY_MOTION, low);
    moves.glide(0, 0.8, 3), moves.says("fast");
    moves.glide(0, 0.1, 9), moves.says("slow");
    moves.glide(0, 0.8), moves.says("fast again");

    ToldLeg released(texts, "a foot is released");
    released.glide(1, 0, 10);
    released.glide(1, 0.4, 5);
    released.glide(0, 0.4), released.says("released");
    released.glide(0, 0.4, 5), released.says("100 ms later");
    released.glide(0, 0.4, 6), released.says("220 ms later");

    for (const float again : {0.06f, 0.0f}) {
        ToldLeg away(texts,
                     again > 0 ? "a foot breaks away" : "a foot breaks away, which never locks in a contact again",
                     kPlants, plant_with(&swivel_plant::relock_speed, again));
        away.glide(1, 0, 10);
        while (!(away.flags() & SWIVEL_RELEASED)) away.glide(1, 0.5);
        away.says("breaks away");
        away.glide(1, 0.5, 2), away.says("40 ms later");
        away.glide(1, 0, 20), away.says("at rest");
    }
    ToldLeg apart(texts, "a foot that is too far to lock");
    apart.glide(1, 0, 10);
    while (!(apart.flags() & SWIVEL_RELEASED)) apart.glide(1, 0.5);
    apart.glide(0, 0.5);
    apart.glide(1, 0.5), apart.says("in contact anew");

    for (const swivel_features cap :
         {swivel_features{0}, SWIVEL_WITH_CAP, SWIVEL_WITH_CAP | SWIVEL_WITH_FLEXION_LIMIT}) {
        const char* const scene = cap & SWIVEL_WITH_FLEXION_LIMIT ? "a cap that binds is no limit of the flexion"
                                  : cap                           ? "a cap keeps a leg from its foot"
                                                                  : "bones keep a leg from its foot";
        ToldLeg high(texts, scene, kPlants | cap, plant_with(&swivel_plant::unlock_radius, 5));
        high.glide(1, 0, 3);
        high.root[1] += 0.3f;
        high.solve(), high.says("the root rises");
        if (cap) high.write(SWIVEL_CAP, Float3{0.01f, 1, 0});
        if (cap) high.solve(), high.says("a cap as long as the bones");
    }
    ToldLeg weighed(texts, "a quarter of a planted leg", kPlants | SWIVEL_WITH_WEIGHTS);
    weighed.write(SWIVEL_WEIGHTS, Float3{0.25f, 1, 1});
    weighed.glide(1, 0, 10);
    weighed.glide(1, 0.5, 5), weighed.says("the root glides");
}

void tell_of_doubts(ApprovedTexts& texts)
{
    ToldLeg bones(texts, "bones in another unit than the skeleton's");
    for (const float stretch : {1.8f, 2.0f, 0.5f}) bones.stretch = stretch, bones.solve(), bones.says("stretched");
    ToldLeg far(texts, "far from the origin");
    far.root[0] = 1e5f;
    far.glide(1, 0, 3), far.says("no support");
    far.support[0] = 1e5f;
    far.glide(1, 0, 3), far.says("a support");
    far.time = 16;
    far.solve(), far.says("milliseconds");
    ToldLeg effector(texts, "an effector in another unit", kStands);
    for (const float length : {8.9f, 11.0f})
        effector.write(SWIVEL_EFFECTOR, Float3{0, 0, length}), effector.solve(), effector.says("longer");
    ToldLeg target(texts, "a target in another unit", kPlants | SWIVEL_WITH_WEIGHTS);
    for (const float weight : {1.0f, 0.0f}) {
        target.write(SWIVEL_TARGET, Float3{0, 13, 0});
        target.write(SWIVEL_WEIGHTS, Float3{weight, 1, 1});
        target.solve(), target.says(weight > 0 ? "written" : "without a weight");
    }
    ToldLeg ground(texts, "ground in another unit", kStands);
    for (const float height : {8.0f, 50.0f}) {
        ground.write(SWIVEL_GROUND, Float3{0, height, 0});
        ground.glide(1, 0, 30), ground.says("written");
    }
    ToldLeg anew(texts, "all bodies are reset before each solve");
    for (int n = 0; n < 3; ++n) anew.crowd.reset(0), anew.glide(1, 0.5), anew.says("reset");
    anew.glide(1, 0.5), anew.says("not reset");
    ToldLeg paused(texts, "a pause that writes over the pose");
    paused.is_in_place = true;
    for (const float time : {GlidingLeg::kFrame, 0.0f}) paused.time = time, paused.solve(), paused.says("in place");
    paused.says("every group", SWIVEL_EVERY_GROUP);
    paused.is_in_place = false;
    paused.solve(), paused.says("into results");
}

void tell_of_bad_poses(ApprovedTexts& texts)
{
    ToldLeg leg(texts, "a bad pose of a planted leg", kPlants | SWIVEL_WITH_HAND);
    leg.glide(1, 0, 3);
    leg.support[2] = kNan;
    leg.solve(), leg.says("its support");
    leg.support[2] = 0;
    leg.rotations[1] = {0, 0, 0, 0};
    leg.solve(), leg.says("its thigh");
    leg.rotations[1] = {0, 0, 0, 1}, leg.rotations[3] = {0, 0, kNan, 0};
    leg.solve(), leg.says("its foot");
    leg.rotations[3] = {0, 0, 0, 1}, leg.root[1] = kNan;
    leg.solve(), leg.says("its root");
    leg.root[1] = 0, leg.time = kNan;
    leg.solve(), leg.says("its time");
    leg.is_masked = true;
    leg.solve(), leg.says("its time, in a job with a mask");
    ToldLeg handless(texts, "a bad pose of a leg without a hand");
    handless.rotations[3] = {0, 0, kNan, 0};
    handless.solve(), handless.says("its foot");
    ToldLeg fits(texts, "a bad time of a leg that fits", kPlants | SWIVEL_WITH_PELVIS_FIT);
    fits.time = kNan;
    fits.solve(), fits.says("its shift", 1);
}

// A cone that no elbow keeps leaves no arc of the swivel's circle; a wide one leaves some.
void tell_of_limits(ApprovedTexts& texts)
{
    ToldLeg leg(texts, "a limit of a body's limb",
                SWIVEL_POLE_INCOMING | SWIVEL_WITH_RECORD | SWIVEL_WITH_SHOULDER_CONE);
    leg.write(SWIVEL_TARGET, Float3{0, 0.4f, 0.1f});
    for (const double angle : {0.01, 3.1415}) {
        leg.write(SWIVEL_SHOULDER_CONE, cone({0, 0, -1}, angle));
        leg.solve(), leg.says(angle < 1 ? "a narrow cone" : "a wide cone");
        std::uint32_t count = 0;
        check(swivel_allowed_arcs(leg.crowd.get(), 0, 0, nullptr, 0, &count));
        CHECK((count > 0) == (angle > 1));
    }
}

void tell_of_shifts(ApprovedTexts& texts)
{
    ToldLeg leg(texts, "a shift of the body", kPlants | SWIVEL_WITH_PELVIS_FIT,
                plant_with(&swivel_plant::unlock_radius, 5));
    leg.says("not solved", 1);
    leg.glide(1, 0, 3), leg.says("at rest", 1);
    leg.root[1] += 0.15f;
    leg.solve(), leg.says("the root rises", 1);
    std::array<float, 3> shift;
    leg.crowd.read(SWIVEL_SHIFT, 1, std::span(&shift, 1));
    CHECK(number_after(leg.text(1), "shifted by ") == Approx(double{shift[0]}).epsilon(6e-4));
    CHECK(number_after(leg.text(1), "along up, at ") == Approx(double{shift[1]}).epsilon(6e-4));
    leg.root[1] += 0.5f;
    leg.write(SWIVEL_SHIFT_WISH, std::array{0.03f}, 1);
    leg.solve(), leg.says("rises too far, with a wish", 1);
    leg.says("every group", SWIVEL_EVERY_GROUP);

    GlidingLeg settles(kPlants | SWIVEL_WITH_PELVIS_FIT);
    for (int n = 0; n < 3; ++n) settles.root[1] = n == 1 ? 0.1f : 0, settles.glide(1, 0, 150);
    settles.crowd.read(SWIVEL_SHIFT, 1, std::span(&shift, 1));
    CHECK((shift[0] != 0 && std::fabs(shift[0]) < 1e-12f));
    CHECK_THAT(settles.text(1), Catch::StartsWith("The body is shifted by 0 along up, at 0 a second, which is"));
    ToldLeg unknown(texts, "a leg without a record", kPlants & ~SWIVEL_WITH_RECORD);
    unknown.says("every group", SWIVEL_EVERY_GROUP);
}

void tell_of_ground(ApprovedTexts& texts)
{
    ToldLeg leg(texts, "ground that is none", kStands);
    leg.glide(1, 0, 3), leg.says("never written");
    leg.stand(0, 1.54);  // 88.2 degrees
    leg.glide(0, 0, 3), leg.says("steep");
    leg.stand(0, 1.5);
    leg.glide(0, 0, 3), leg.says("nearly so");
    leg.write(SWIVEL_GROUND, Float3{0, kInf, 0});
    leg.glide(0, 0, 3), leg.says("infinite");

    for (const double height : {0.05, -0.04}) {
        ToldLeg foot(texts, height > 0 ? "ground lifts a foot" : "ground lowers a foot", kStands);
        const double level = foot.toe().y();  // the root stands at 0
        foot.stand(level, 0);
        foot.glide(0, 0, 3);
        foot.stand(level - height, 0);
        for (int n = 0; n < 4; ++n) {
            foot.glide(0, 0);
            const double lift = foot.sent.back().y() - foot.toe().y();
            CHECK(number_after(foot.text(), "its foot by ") == Approx(std::fabs(lift)).epsilon(1e-3));
        }
        foot.says("on its way");
        foot.glide(0, 0, 40), foot.says("there");
    }
    ToldLeg foot(texts, "a foot turns with the ground", kStands);
    foot.turn_foot(turned(0.2, Vector3d::UnitZ()));
    foot.stand(0.3, 0.1, Vector3d::UnitZ());
    foot.glide(0, 0, 3), foot.says("5.7 degrees");
    ToldLeg max(texts, "a foot turns with steep ground, by 36.9 degrees at the most", kStands);
    max.stand(0.5, 0.9, Vector3d::UnitZ());
    max.glide(0, 0, 3), max.says("51.6 degrees");
    max.write(SWIVEL_GROUND_WEIGHT, std::array{0.5f});
    // Half of a turn, as rotors blend: tan(half the turn) = 0.5 sin 0.9 / (1 + 0.5 (1 + cos 0.9)).
    max.glide(0, 0, 3), max.says("by half, 24.4 degrees");
    max.write(SWIVEL_GROUND_WEIGHT, std::array{0.0f});
    max.glide(0, 0, 3), max.says("not at all");

    ToldLeg heel(texts, "a heel stays over the ground", kStands);
    heel.turn_foot(turned(-0.3, Vector3d::UnitX()));
    heel.stand(heel.toe().y(), 0);
    heel.glide(1, 0, 30), heel.says("toes up by 17.2 degrees");
    heel.write(SWIVEL_HAND, floats(turned(-0.2, Vector3d::UnitX())));
    heel.write(SWIVEL_TARGET, floats(heel.toe()));
    heel.stand(0, 0);
    heel.glide(1, 0, 30), heel.says("a hand that is written, up by 11.5 degrees");
    ToldLeg turns(texts, "a planted rotation is not known", kStands | SWIVEL_WITH_PLANT_ROTATION);
    turns.stand(turns.toe().y(), 0.2, Vector3d::UnitZ());
    turns.glide(1, 0, 30), turns.says("a slope");
}

}  // namespace

TEST_CASE("explain speaks of feet as approved")
{
    ApprovedTexts texts("feet.txt");
    tell_of_contact(texts);
    tell_of_doubts(texts);
    tell_of_bad_poses(texts);
    tell_of_limits(texts);
    tell_of_shifts(texts);
    tell_of_ground(texts);
    texts.compare();
}
