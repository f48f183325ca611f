// SPDX-License-Identifier: MIT
#include "tests/random_figure.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

namespace swivel::test {

namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

class FigureMaker {
public:
    // draws: the bones' lengths and bends are random, too.
    FigureMaker(std::mt19937& random, const FigureWish& wish, const Body& body, bool draws)
        : random_(random), wish_(wish), body_(body), draws_(draws)
    {
    }

    Figure make()
    {
        const double size = wish_.scales > 0 ? std::pow(10.0, 2 * any()) : 1;
        Vector3d scale = size * body_.scale;
        if (likely(wish_.mirrors)) scale.x() = -size;
        figure_.is_mirrored = scale.x() < 0;
        if (likely(wish_.uneven)) spoil(scale);
        Eigen::Isometry3d armature = Eigen::Isometry3d::Identity();
        if (wish_.random_axes) armature.rotate(any_turn());
        if (draws_) armature.translation() = any() * Vector3d(1, -0.5, 0.3);
        const int above = add("Armature", -1, armature, scale),
                  root = add("Root", above, Eigen::Isometry3d(body_.turn), Vector3d::Ones());
        figure_.front = (poses_[1].linear() * Vector3d::UnitZ()).normalized();
        const int hips = joint("hips", root, {0, 1, 0}, Part::trunk),
                  chest = joint("chest", hips, {0, 1.5, 0}, Part::trunk);
        if (!body_.clip.empty() || body_.between) clip_ = figure_.rig.add_animation("clip");
        for (LimbNodes& limb : figure_.limbs) limb = {-1, -1, -1};
        for (const std::size_t limb : body_.limbs) add_limb(limb, limb < 2 ? chest : hips);
        if (wish_.moves) move();
        return figure_;
    }

private:
    double any() { return std::uniform_real_distribution<double>(-1, 1)(random_); }
    bool likely(double share) { return std::uniform_real_distribution<double>(0, 1)(random_) < share; }
    Quaterniond any_turn() { return Quaterniond(any(), any(), any(), any()).normalized(); }
    void spoil(Vector3d& scale) { scale.y() *= 1 + wish_.uneven_by; }

    // A node whose axes lie as `frame` has it in its parent's.
    int add(const std::string& name, int parent, const Eigen::Isometry3d& frame, const Vector3d& scale)
    {
        const int node = figure_.rig.add(name, parent, frame.translation(), Quaterniond(frame.rotation()), scale);
        const Eigen::Affine3d above =
            parent < 0 ? Eigen::Affine3d::Identity() : poses_[static_cast<std::size_t>(parent)];
        poses_.push_back(above * frame * Eigen::Scaling(scale));
        return node;
    }
    enum class Part { trunk, bone, tip };

    // A joint at a place in the figure's space, turned against its parent, or with any axes. A bone may have a mirror
    // of its own; the scale of a tip moves no limb.
    int joint(const std::string& name, int parent, const Vector3d& place, Part part,
              Quaterniond turn = Quaterniond::Identity())
    {
        const Eigen::Affine3d& above = poses_[static_cast<std::size_t>(parent)];
        const Vector3d local = above.inverse() * (poses_[1] * place);
        const double size = likely(wish_.scales) ? std::exp(any()) : 1;
        Vector3d scale = Vector3d::Constant(size);
        if (part != Part::trunk && likely(wish_.mirrors / 3)) scale[static_cast<int>(random_() % 3)] = -size;
        if (part != Part::trunk && likely(wish_.mirrors / 3)) scale = -scale;
        if (part != Part::tip && likely(wish_.uneven / 10)) spoil(scale);
        if (part == Part::tip && likely(wish_.uneven)) scale.z() *= 1.3;
        if (wish_.random_axes) turn = any_turn();
        return add(name, parent, Eigen::Isometry3d(Eigen::Translation3d(local) * turn), scale);
    }
    // Joints on the way from one of a limb's to the next. The last of them.
    int twists(const std::string& base, int parent, const Vector3d& from, const Vector3d& to)
    {
        if (likely(wish_.twist_bones))
            joint(base + "_twist_01", parent, from + 0.3 * (to - from), Part::tip);  // beside
        if (likely(wish_.twist_bones)) {
            parent = joint(base + " Bob", parent, from + 0.5 * (to - from), Part::bone);
            twists_.push_back(parent);
        }
        if (likely(wish_.twist_bones)) {
            parent = joint(base + "_twist_02", parent, from + 0.8 * (to - from), Part::bone);
            twists_.push_back(parent);
        }
        return parent;
    }
    int between(int upper, const Vector3d& from, const Vector3d& to)
    {
        const int node = joint(body_.between->name, upper, (from + to) / 2, Part::bone);
        figure_.rig.add_keys(clip_, node, "rotation", times(2),
                             turns(body_.between->axis, {0, body_.between->degrees}));
        return node;
    }
    void add_limb(std::size_t limb, int parent)
    {
        const bool is_arm = limb < 2, is_left = limb % 2 == 0;
        const double x = is_left ? body_.left_at : -body_.left_at;
        const std::array<const char*, 3> parts =
            is_arm ? std::array{"Arm", "ForeArm", "Hand"} : std::array{"UpLeg", "Leg", "Foot"};
        const auto name = [&](const std::string& part) { return (is_left ? "Left" : "Right") + part; };
        const Vector3d of_left = is_arm ? body_.arm_bone : body_.leg_bone,
                       top = is_arm ? Vector3d(0.2 * x, 1.5, 0) : Vector3d(0.1 * x, 1, 0);
        Vector3d bone(x * of_left.x(), of_left.y(), of_left.z());
        double lower = bone.norm(), bend = body_.rest[limb] * kDegree;
        if (draws_) {
            if (is_arm) bone.y() += 0.3 * bone.norm() * any();
            bone = (0.3 + 0.1 * any()) * bone.normalized();
            lower = 0.3 + 0.1 * any();
            bend = wish_.bent ? 0.2 + std::abs(any()) : 0;
        }
        const Vector3d across = bone.cross(is_arm ? Vector3d(kZ) : Vector3d(-kZ));
        const Vector3d axis = across.norm() < 1e-9 ? Vector3d(kX) : Vector3d(across.normalized());
        const Quaterniond turn(AngleAxisd(bend, axis));
        const Vector3d elbow = top + bone, wrist = elbow + turn * (lower * bone.normalized());
        LimbNodes& nodes = figure_.limbs[limb];
        nodes[0] = joint(name(parts[0]), parent, top, Part::bone);
        const int above =
            body_.between && limb == 0 ? between(nodes[0], top, elbow) : twists(name(parts[0]), nodes[0], top, elbow);
        nodes[1] = joint(name(parts[1]), above, elbow, Part::bone, turn);
        nodes[2] =
            joint(name(parts[2]), twists(name(parts[1]), nodes[1], elbow, wrist), wrist, Part::tip, turn.conjugate());
        if (!is_arm && body_.toe_step) {
            const Vector3d& step = *body_.toe_step;
            joint(name(body_.toe), nodes[2], wrist + Vector3d(x * step.x(), step.y(), step.z()), Part::tip);
        }
        figure_.upper[limb] = (poses_[1].linear() * (elbow - top)).norm();
        figure_.lower[limb] = (poses_[1].linear() * (wrist - elbow)).norm();
        if (body_.clip.empty()) return;
        const AngleAxisd aside(body_.aside[limb] * kDegree, bone.normalized());
        std::vector<double> degrees;
        for (const Bends& frame : body_.clip) degrees.push_back(frame[limb]);
        figure_.rig.add_keys(clip_, nodes[1], "rotation", times(degrees.size()), turns(aside * axis, degrees));
    }
    static std::vector<float> times(std::size_t count)
    {
        std::vector<float> seconds;
        for (std::size_t n = 0; n < count; ++n) seconds.push_back(static_cast<float>(n) / 30);
        return seconds;
    }

    bool is_between(int node) const { return std::find(twists_.begin(), twists_.end(), node) != twists_.end(); }
    // A turn of a joint; what lies between two of a limb's turns about the bone.
    Quaterniond turn_of(int node)
    {
        if (!is_between(node)) return any_turn();
        const auto& at = figure_.rig.json["nodes"][static_cast<std::size_t>(node)];
        const std::vector<double> along = at["translation"], rest = at["rotation"];
        const Vector3d bone = Vector3d(along[0], along[1], along[2]).normalized();
        return AngleAxisd(2 * any(), bone) * Quaterniond(rest[3], rest[0], rest[1], rest[2]);
    }
    // Five keys for every joint; now and then a bone stretches.
    void move()
    {
        const int animation = figure_.rig.add_animation("motion");
        const std::vector<float> times = {0, 0.25f, 0.5f, 0.75f, 1};
        for (int node = 1; node < static_cast<int>(poses_.size()); ++node) {
            std::vector<float> keys;
            for (std::size_t n = 0; n < times.size(); ++n)
                for (const double part : Eigen::Vector4d(turn_of(node).coeffs()))
                    keys.push_back(static_cast<float>(part));
            figure_.rig.add_keys(animation, node, "rotation", times, keys, random_() % 4 == 0 ? "STEP" : "LINEAR");
            if (is_between(node) || !likely(wish_.scales / 4)) continue;
            const std::vector<double> rest = figure_.rig.json["nodes"][static_cast<std::size_t>(node)]["translation"];
            std::vector<float> places;
            for (std::size_t n = 0; n < times.size(); ++n)
                for (const double part : rest)
                    places.push_back(static_cast<float>(part * (1 + 0.2 * static_cast<double>(n))));
            figure_.rig.add_keys(animation, node, "translation", times, places);
        }
    }

    std::mt19937& random_;
    FigureWish wish_;
    Body body_;
    bool draws_;
    Figure figure_;
    int clip_ = -1;
    std::vector<Eigen::Affine3d> poses_;  // of each node, in the world; 1: the figure
    std::vector<int> twists_;             // nodes
};

}  // namespace

Figure figure_of(const Body& body)
{
    std::mt19937 unused;
    return FigureMaker(unused, {.random_axes = false, .moves = false}, body, false).make();
}

Figure random_figure(std::mt19937& random, const FigureWish& wish)
{
    Body body;
    if (!wish.toes) body.toe_step = {};
    return FigureMaker(random, wish, body, true).make();
}

std::vector<float> turns(const Eigen::Vector3d& axis, const std::vector<double>& degrees)
{
    std::vector<float> keys;
    for (const double angle : degrees) {
        const Eigen::Quaterniond q(Eigen::AngleAxisd(angle * kDegree, axis));
        for (const double value : {q.x(), q.y(), q.z(), q.w()}) keys.push_back(static_cast<float>(value));
    }
    return keys;
}

nlohmann::json report_of(const fs::path& folder, Words words, int exit_code)
{
    words.push_back("--json");
    const Outcome outcome = run_command(folder, words);
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == exit_code);
    CHECK(outcome.err.empty() == (exit_code == 0));
    return nlohmann::json::parse(outcome.out);
}

nlohmann::json rig_report(const GltfRig& rig)
{
    const TempFolder folder;
    rig.write(folder / "rig.glb");
    const Outcome outcome = run_command(folder.path, {"rig", "rig.glb", "--json"});
    INFO(outcome.err);
    REQUIRE(!outcome.out.empty());
    return nlohmann::json::parse(outcome.out);
}

nlohmann::json limb_of(const nlohmann::json& report, const std::string& name)
{
    for (const nlohmann::json& limb : report.at("limbs"))
        if (limb.at("limb") == name) return limb;
    FAIL("no limb " + name);
    return {};
}

Eigen::Vector3d vector_of(const nlohmann::json& numbers) { return Eigen::Vector3d(numbers[0], numbers[1], numbers[2]); }

double degrees_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
    return std::atan2(a.cross(b).norm(), a.dot(b)) / kDegree;
}

std::string problem_of(const nlohmann::json& report, const std::string& limb)
{
    return limb_of(report, limb).value("problem", "");
}

}  // namespace swivel::test
