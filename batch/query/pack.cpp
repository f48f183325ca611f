// SPDX-License-Identifier: MIT
//
// The C entry points that pack results into 16-bit words and unpack them. simd/pack.h packs a block, core/pack.h a
// value.
#include "core/pack.h"

#include <utility>

#include "batch/api/use.h"
#include "core/arm.h"
#include "simd/dispatch.h"
#include "simd/float_env.h"
#include "simd/rows.h"

using namespace swivel;

namespace {

// Each value takes a row at least.
constexpr std::size_t kMaxValues = [] {
    std::size_t rows = 0;
    for (const FieldRow& row : kFields) rows += packed_row_count(kEveryFeature, row.field);
    return rows;
}();

struct PackedValues {
    PackedValue values[kMaxValues];
    std::uint32_t count = 0, word_rows = 0;

    explicit PackedValues(const Group& group)
    {
        for (std::size_t f = kInputCount; f < kFieldCount; ++f) {
            const swivel_field field = kFields[f].field;
            const std::uint32_t end = word_rows + packed_row_count(group.features, field);
            std::uint32_t from = group.first_row[f];
            const Packing how = field == SWIVEL_FLAGS                             ? Packing::flags
                                : field_row_count(group.features, field) % 4 == 0 ? Packing::rotation
                                                                                  : Packing::half;
            while (word_rows < end) {
                values[count++] = {how, static_cast<std::uint16_t>(from), static_cast<std::uint16_t>(word_rows)};
                from += how == Packing::rotation ? 4 : 1;
                word_rows += how == Packing::rotation ? 3 : how == Packing::flags ? 2 : 1;
            }
        }
    }
};

double component(std::uint32_t word)
{
    return (static_cast<int>(word & (kPackedTopBit - 1)) - kPackedZero) / kPackedSteps;
}

}  // namespace

uint32_t swivel_packed_row(const swivel_crowd* crowd, uint32_t group, swivel_field field)
{
    if (!crowd || group >= crowd->group_count) return 0;
    std::uint32_t rows = 0;
    for (std::size_t f = kInputCount; f < kFieldCount && kFields[f].field < field; ++f)
        rows += packed_row_count(crowd->groups[group].features, kFields[f].field);
    return rows;
}

swivel_status swivel_pack(const swivel_crowd* crowd, uint32_t group, swivel_blocks blocks, uint16_t* words)
{
    const FloatEnv env;
    const Use use(crowd, Sharing::shared);
    swivel_status status = use.for_limbs(group, 0, 0);
    if (status != SWIVEL_OK) return status;
    const Group& whole_group = crowd->groups[group];
    if (blocks.count > whole_group.block_count || blocks.first > whole_group.block_count - blocks.count)
        return refuse("blocks %u + %u are out of range; group %u has %u", blocks.first, blocks.count, group,
                      whole_group.block_count);
    if (!words && blocks.count > 0) return refuse("swivel_pack: words is null");
    const Isa* const isa = usable_isa(status);
    if (!isa) return status;
    const PackedValues packed(whole_group);
    isa->kernels.arms.pack(
        {whole_group.results + row_offset(std::size_t{blocks.first} * SWIVEL_LANES, whole_group.result_row_count, 0),
         words, blocks.count, whole_group.result_row_count, packed.word_rows, packed.values, packed.count});
    return SWIVEL_OK;
}

void swivel_unpack_rotation(const uint16_t* words, size_t word_stride, float xyzw[4])
{
    const FloatEnv env;
    const std::uint32_t first = words[0], second = words[word_stride], third = words[2 * word_stride];
    const std::uint32_t left_out = first >> 15 | second >> 15 << 1;
    const double a = component(first), b = component(second), c = component(third);
    const double rest = 1 - ((a * a + b * b) + c * c), largest = std::sqrt(rest > 0 ? rest : 0);
    double in_order[4] = {a, b, c, largest};
    for (std::uint32_t n = 3; n > left_out; --n) std::swap(in_order[n], in_order[n - 1]);
    const Rotor<double> q = hemisphere(rotor(in_order[0], in_order[1], in_order[2], in_order[3]));
    const double unpacked[4] = {q.at<kI>(), q.at<kJ>(), q.at<kK>(), q.at<kScalar>()};
    for (std::size_t n = 0; n < 4; ++n) xyzw[n] = static_cast<float>(unpacked[n]);
}

// Needs no FloatEnv: integer operations convert a normal half. A denormal half is a normal float, and its product with
// 2^-24 is exact under any rounding and flushing.
float swivel_unpack_half(uint16_t word)
{
    const std::uint32_t sign = std::uint32_t{word} >> 15 << 31, exponent = word >> 10 & 31u, digits = word & 1023u;
    if (exponent == 0) {
        const float size = static_cast<float>(digits) * 0x1p-24f;
        return bit_cast<float>(bit_cast<std::uint32_t>(size) | sign);
    }
    const std::uint32_t of_float = exponent == 31 ? 255 : exponent + 112;  // 112: the biases' difference
    return bit_cast<float>(sign | of_float << 23 | digits << 13);
}
