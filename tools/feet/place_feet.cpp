// SPDX-License-Identifier: MIT
#include "tools/feet/place_feet.h"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <array>

#include "tools/feet/treads.h"
#include "tools/formats/error.h"

namespace swivel::tools {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Weights at 60 frames a second, of squares of lengths. Those of second differences go with the cube of the rate, and
// others against it. So the sums over frames stand for the same integrals at any rate.
constexpr double kSmooth = 20, kTogether = 0.005, kHome = 0.02, kAsBent = 1, kReach = 1000, kJump = 1000, kGround = 1e4,
                 kClear = 30;
constexpr double kStraightest = 0.995;  // share of both bones: a knee bent by 11 degrees
constexpr double kJumpShare = 0.995;    // of the clip's largest jump: a weight leaves a little of what it forbids
constexpr int kMaxRounds = 30;
constexpr double kSettled = 1e-5;  // leg lengths

// A place or a difference of places: a sum of unknowns, three numbers each, and a known part.
struct Sum {
    std::array<int, 3> unknown{};
    std::array<double, 3> factor{};
    int count = 0;
    Vector3d known = Vector3d::Zero();

    Sum& add(const Sum& other, double times)
    {
        for (int n = 0; n < other.count; ++n) {
            unknown[static_cast<std::size_t>(count)] = other.unknown[static_cast<std::size_t>(n)];
            factor[static_cast<std::size_t>(count++)] = times * other.factor[static_cast<std::size_t>(n)];
        }
        known += times * other.known;
        return *this;
    }
    Vector3d at(const VectorXd& values) const
    {
        Vector3d sum = known;
        for (std::size_t n = 0; n < static_cast<std::size_t>(count); ++n)
            sum += factor[n] * values.segment<3>(3 * unknown[n]);
        return sum;
    }
};

Sum second_difference(const std::vector<Sum>& sums, std::size_t frame)
{
    return Sum().add(sums[frame - 1], 1).add(sums[frame], -2).add(sums[frame + 1], 1);
}

// A sum of squares: its matrix, whose lower half counts, and its right side.
struct Squares {
    std::vector<Eigen::Triplet<double>> entries;
    VectorXd right;

    explicit Squares(int unknown_count) : right(VectorXd::Zero(3 * unknown_count)) {}

    // Asks for this value of the sum along a direction.
    void want(const Sum& sum, const Vector3d& direction, double value, double weight)
    {
        const double rest = value - direction.dot(sum.known);
        for (std::size_t n = 0; n < static_cast<std::size_t>(sum.count); ++n) {
            const Vector3d own = weight * sum.factor[n] * direction;
            right.segment<3>(3 * sum.unknown[n]) += rest * own;
            for (std::size_t m = 0; m < static_cast<std::size_t>(sum.count); ++m)
                for (int i = 0; i < 3; ++i)
                    for (int j = 0; j < 3; ++j) {
                        const int row = 3 * sum.unknown[n] + i, column = 3 * sum.unknown[m] + j;
                        const double entry = own[i] * sum.factor[m] * direction[j];
                        if (row >= column && entry != 0) entries.emplace_back(row, column, entry);
                    }
        }
    }
    void want_at(const Sum& sum, const Vector3d& value, double weight)
    {
        for (int axis = 0; axis < 3; ++axis) want(sum, Vector3d::Unit(axis), value[axis], weight);
    }
    void want_small(const Sum& sum, double weight) { want_at(sum, Vector3d::Zero(), weight); }
    Eigen::SparseMatrix<double> matrix() const
    {
        Eigen::SparseMatrix<double> matrix(right.size(), right.size());
        matrix.setFromTriplets(entries.begin(), entries.end());
        return matrix;
    }
};

// A contact's toe: its unknown, its height over the ground, and its new place if an edge is below its sole.
struct Stand {
    Sum toe;
    double height;
    std::optional<Vector3d> tread_w;  // none: it can stand nowhere near
    bool is_at_edge;                  // so it goes to this tread
    Contact frames;
};

struct LegSums {
    std::vector<Vector3d> on_ground_w;  // the clip's toe, lifted with its ground
    std::vector<Sum> change, toe;       // from there; and where it is then
    std::vector<Stand> stands;
};

class Problem {
public:
    Problem(const LegMotion& motion, const Contacts& contacts, const ContactBars& bars, const Floor& floor)
        : motion_(motion),
          floor_(floor),
          is_down_(contacts),
          lift_(lift_of(motion, contacts, floor)),
          pace_(60 * motion.frame_time)
    {
        for (std::size_t frame = 0; frame < motion.frame_count(); ++frame) {
            body_.push_back(new_unknown());
            body_at_.push_back(body_.back());
            body_at_.back().known = motion.carrier_w[frame] + lift_w(frame);
        }
        for (std::size_t leg = 0; leg < motion.legs.size(); ++leg) {
            add_leg(motion.legs[leg], lift_.legs[leg].move_w, contacts[leg], bars);
            toes_jump_ = std::max(toes_jump_, largest_jump(motion.legs[leg].toe_w));
        }
    }

    PlacedFeet solve(const std::filesystem::path& file)
    {
        const Squares lasting = linear_part();
        const Eigen::SparseMatrix<double> matrix = lasting.matrix();
        VectorXd values = VectorXd::Zero(3 * unknown_count_);
        for (int round = 0; round < kMaxRounds; ++round) {
            const Squares now = part_about(values);
            const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factored(matrix + now.matrix());
            const VectorXd next = factored.solve(lasting.right + now.right);
            if (factored.info() != Eigen::Success || !next.allFinite())
                throw formats::InputError(file, fmt::format("has frames of {:g} s and legs {:.4g} long, and with these "
                                                            "its feet cannot be placed; check its frame time and unit",
                                                            motion_.frame_time, motion_.leg_length()));
            const double step = (next - values).lpNorm<Eigen::Infinity>();
            values = next;
            if (step < kSettled * motion_.leg_length()) break;
        }
        return placed(values);
    }

private:
    Sum new_unknown() { return {{unknown_count_++}, {1}, 1}; }

    void add_leg(const LegPath& path, const std::vector<Vector3d>& move_w, const std::vector<bool>& contact,
                 const ContactBars& bars)
    {
        LegSums leg;
        for (std::size_t frame = 0; frame < contact.size(); ++frame)
            leg.on_ground_w.push_back(path.toe_w[frame] + move_w[frame]);
        for (std::size_t frame = 0; frame < contact.size(); ++frame) {
            const bool goes_on = contact[frame] && frame > 0 && contact[frame - 1];
            // A contact's unknown is the change in its first frame.
            Sum toe = goes_on ? leg.toe.back() : new_unknown();
            if (!goes_on) toe.known = leg.on_ground_w[frame];
            leg.toe.push_back(toe);
            leg.change.push_back(toe);
            leg.change.back().known -= leg.on_ground_w[frame];
        }
        for (const Contact& each : contacts_of(contact)) {
            const std::size_t middle = middle_of(each);
            const std::optional<Vector3d> tread_w = tread_near(motion_, path, middle, floor_);
            leg.stands.push_back({leg.toe[each.first], stand_height(motion_, path, each, bars, floor_), tread_w,
                                  tread_w && *tread_w != path.toe_w[middle], each});
        }
        legs_.push_back(std::move(leg));
    }

    // How far the hills lift the body.
    Vector3d lift_w(std::size_t frame) const { return lift_.body[frame] * motion_.up_w; }

    // From up to the ground's normal, which is less than a right angle from it. Eigen's FromTwoVectors() gives the
    // same, but takes long to compile: for opposite vectors it has a singular value decomposition.
    Quaterniond turn_w(std::size_t leg, std::size_t frame) const
    {
        const Vector3d up = motion_.up_w.normalized(), normal = lift_.legs[leg].normal_w[frame];
        const double twice_half = std::sqrt((1 + normal.dot(up)) * 2);
        Quaterniond turn;
        turn.vec() = up.cross(normal) * (1 / twice_half);
        turn.w() = twice_half * 0.5;
        return turn;
    }
    Vector3d foot_w(const LegPath& path, std::size_t frame) const { return path.ankle_w[frame] - path.toe_w[frame]; }

    Squares linear_part() const
    {
        Squares squares(unknown_count_);
        const auto smooth = [&](const std::vector<Sum>& change) {
            for (std::size_t frame = 1; frame + 1 < change.size(); ++frame)
                squares.want_small(second_difference(change, frame), kSmooth / (pace_ * pace_ * pace_));
        };
        smooth(body_);
        for (const Sum& body : body_) squares.want_small(body, kHome * pace_);
        for (const LegSums& leg : legs_) {
            smooth(leg.change);
            for (std::size_t frame = 0; frame < body_.size(); ++frame)
                squares.want_small(Sum(leg.change[frame]).add(body_[frame], -1), kTogether * pace_);
        }
        return squares;
    }

    // The rest, as it is near these values.
    Squares part_about(const VectorXd& values)
    {
        Squares squares(unknown_count_);
        add_jumps(body_at_, largest_jump(motion_.carrier_w), values, squares);
        for (std::size_t n = 0; n < legs_.size(); ++n) {
            LegSums& leg = legs_[n];
            for (std::size_t frame = 0; frame < body_.size(); ++frame) add_reach(n, frame, values, squares);
            add_jumps(leg.toe, toes_jump_, values, squares);
            for (Stand& stand : leg.stands) add_stand(n, stand, values, squares);
            if (floor_.hills) add_clearing(n, values, squares);
        }
        return squares;
    }

    void add_stand(std::size_t n, Stand& stand, const VectorXd& values, Squares& squares) const
    {
        const Vector3d toe_w = stand.toe.at(values);
        // For good: else it would go to and fro from round to round.
        if (!stand.is_at_edge && stand.tread_w)
            stand.is_at_edge = !can_stand(motion_, motion_.legs[n], middle_of(stand.frames), toe_w, floor_);
        const Vector3d ground_w = stand.is_at_edge ? *stand.tread_w : toe_w;
        const Vector3d point_w = ground_w + (stand.height - floor_.over(ground_w)) * motion_.up_w;
        if (stand.is_at_edge) return squares.want_at(stand.toe, point_w, kGround);
        const Vector3d normal_w = floor_.normal_w(ground_w);  // of the plane through that point
        squares.want(stand.toe, normal_w, normal_w.dot(point_w), kGround);
    }

    // A toe in the air is no deeper in the ground than it is in the clip.
    void add_clearing(std::size_t n, const VectorXd& values, Squares& squares) const
    {
        for (std::size_t frame = 0; frame < body_.size(); ++frame) {
            const Vector3d now_w = legs_[n].toe[frame].at(values);
            const double own = motion_.legs[n].toe_w[frame].dot(motion_.up_w) - floor_.level;
            const double lacks = std::min(own, 0.0) - floor_.over(now_w);
            if (is_down_[n][frame] || lacks <= 0) continue;
            const Vector3d normal_w = floor_.normal_w(now_w), point_w = now_w + lacks * motion_.up_w;
            squares.want(legs_[n].toe[frame], normal_w, normal_w.dot(point_w), kClear * pace_);
        }
    }

    void add_reach(std::size_t n, std::size_t frame, const VectorXd& values, Squares& squares) const
    {
        const LegPath& path = motion_.legs[n];
        Sum leg = Sum(legs_[n].toe[frame]).add(body_[frame], -1);  // from hip to ankle
        leg.known += turn_w(n, frame) * foot_w(path, frame) - path.hip_w[frame] - lift_w(frame);
        const Vector3d now = leg.at(values);
        const double bones = (path.knee_w[frame] - path.hip_w[frame]).norm() +
                             (path.ankle_w[frame] - path.knee_w[frame]).norm(),
                     max = kStraightest * bones, own = (path.ankle_w[frame] - path.hip_w[frame]).norm();
        squares.want(leg, now.normalized(), std::min(own, max), kAsBent * pace_);
        if (now.norm() > max) squares.want(leg, now.normalized(), max, kReach * pace_);
    }

    // A velocity jumps no more than it does in the clip.
    void add_jumps(const std::vector<Sum>& places, double max, const VectorXd& values, Squares& squares) const
    {
        for (std::size_t frame = 1; frame + 1 < places.size(); ++frame) {
            const Sum change = second_difference(places, frame);
            const Vector3d now = change.at(values);
            if (now.norm() > kJumpShare * max)
                squares.want(change, now.normalized(), kJumpShare * max, kJump / (pace_ * pace_ * pace_));
        }
    }

    PlacedFeet placed(const VectorXd& values) const
    {
        PlacedFeet placed;
        placed.legs.resize(legs_.size());
        for (std::size_t frame = 0; frame < body_.size(); ++frame) {
            placed.shift_w.push_back(body_[frame].at(values) + lift_w(frame));
            for (std::size_t n = 0; n < legs_.size(); ++n) {
                PlacedLeg& leg = placed.legs[n];
                leg.toe_w.push_back(legs_[n].toe[frame].at(values));
                leg.turn_w.push_back(turn_w(n, frame));
                leg.ankle_w.push_back(leg.toe_w.back() + leg.turn_w.back() * foot_w(motion_.legs[n], frame));
            }
        }
        return placed;
    }

    const LegMotion& motion_;
    const Floor& floor_;
    const Contacts& is_down_;
    Lift lift_;
    double pace_;  // seconds a frame, in sixtieths
    int unknown_count_ = 0;
    std::vector<Sum> body_, body_at_;  // its change, beside the hills' lift; and where it is then
    double toes_jump_ = 0;             // the largest of the clip
    std::vector<LegSums> legs_;
};

}  // namespace

double stand_height(const LegMotion& motion, const LegPath& path, const Contact& contact, const ContactBars& bars,
                    const Floor& floor)
{
    double height = 0;
    for (std::size_t frame = contact.first; frame < contact.end; ++frame)
        height += path.toe_w[frame].dot(motion.up_w) - floor.level;
    height /= static_cast<double>(contact.end - contact.first);
    return std::abs(height) > bars.height * path.length ? height : 0;
}

PlacedFeet place_feet(const LegMotion& motion, const Contacts& contacts, const ContactBars& bars, const Floor& floor,
                      const std::filesystem::path& file)
{
    return Problem(motion, contacts, bars, floor).solve(file);
}

}  // namespace swivel::tools
