// SPDX-License-Identifier: MIT
//
// The C entry points that save, load and clear what limbs carry from solve to solve. The state of a body in bytes is
// words of 32 bits, the low byte first: one that tells the layout, then the numbers of each group.
#include "batch/query/state.h"

#include <algorithm>

#include "batch/api/check.h"
#include "batch/api/use.h"
#include "batch/crowd/streams.h"
#include "batch/refusal/status.h"
#include "core/num.h"

using namespace swivel;

namespace {

constexpr std::size_t kWordBytes = 4;

void store_word(std::uint32_t word, unsigned char* bytes)
{
    for (std::size_t n = 0; n < kWordBytes; ++n) bytes[n] = static_cast<unsigned char>(word >> 8 * n);
}
std::uint32_t load_word(const unsigned char* bytes)
{
    std::uint32_t word = 0;
    for (std::size_t n = 0; n < kWordBytes; ++n) word |= std::uint32_t{bytes[n]} << 8 * n;
    return word;
}

struct StateLayout {
    std::uint32_t word;  // crowds of equal layouts have equal words, others almost surely not
    std::size_t bytes;   // of one body's state
};
StateLayout state_layout(const swivel_crowd& crowd)
{
    constexpr std::uint32_t kVersion = 1;  // goes up where numbers of the same fields change their meaning
    StateLayout layout{kVersion, kWordBytes};
    const auto add = [&](std::uint32_t number) { layout.word = (layout.word ^ number) * 16777619u; };  // as FNV-1a does
    for (std::uint32_t g = 0; g < crowd.group_count; ++g) {
        add(g);
        for_each_state_result(crowd.groups[g], [&](const FieldRow& result, std::uint32_t, std::uint32_t count) {
            add(static_cast<std::uint32_t>(result.field));
            add(count);
            layout.bytes += count * kWordBytes;
        });
    }
    return layout;
}

// The first group whose number of limbs is not that of group 0; the group count if there is none.
std::uint32_t first_unequal_group(const swivel_crowd& crowd)
{
    std::uint32_t g = 0;
    while (g < crowd.group_count && crowd.groups[g].limb_count == crowd.groups[0].limb_count) ++g;
    return g;
}

swivel_status check_bodies(const swivel_crowd& crowd, std::uint32_t first_body, std::uint32_t body_count,
                           const char* call)
{
    const std::uint32_t has = crowd.groups[0].limb_count, unequal = first_unequal_group(crowd);
    if (unequal < crowd.group_count)
        return refuse("%s: group %u has %u limbs, group 0 has %u; a body has a limb of each, so make a crowd for each",
                      call, unequal, crowd.groups[unequal].limb_count, has);
    if (first_body > has || body_count > has - first_body)
        return refuse("%s: %u bodies from body %u on are not all in this crowd, which has %u", call, body_count,
                      first_body, has);
    return SWIVEL_OK;
}

// Some bodies, and the caller's memory for their state.
swivel_status check_state(const swivel_crowd& crowd, std::uint32_t first_body, std::uint32_t body_count,
                          const void* bytes, std::size_t size, const char* call)
{
    if (const swivel_status status = check_bodies(crowd, first_body, body_count, call); status != SWIVEL_OK)
        return status;
    if (!bytes && body_count > 0) return refuse("%s: bytes is null", call);
    const std::size_t each = state_layout(crowd).bytes;
    if (size / each < body_count)
        return refuse("%s: size is %zu, but %u bodies have %zu bytes each", call, size, body_count, each);
    return SWIVEL_OK;
}

// Calls copy(number, bytes) for each number of the state of these bodies. bytes: of the first body's state.
template <class Byte, class Copy>
void for_each_number(const swivel_crowd& crowd, std::uint32_t first_body, std::uint32_t body_count, Byte* bytes,
                     std::size_t body_bytes, const Copy& copy)
{
    const std::uint32_t end = first_body + body_count;
    std::uint32_t body = first_body;
    while (body < end) {  // the bodies of a block at a time
        const std::uint32_t next = std::min(end, (body / kLanes + 1) * kLanes);
        Byte* number_bytes = bytes + (body - first_body) * body_bytes + kWordBytes;
        for (const Group* group = crowd.groups; group != crowd.groups + crowd.group_count; ++group)
            for_each_state_result(*group, [&](const FieldRow&, std::uint32_t first_row, std::uint32_t count) {
                for (std::uint32_t row = first_row; row < first_row + count; ++row, number_bytes += kWordBytes) {
                    float* const numbers = group->results + row_offset(body, group->result_row_count, row);
                    for (std::uint32_t n = 0; n < next - body; ++n) copy(numbers[n], number_bytes + n * body_bytes);
                }
            });
        body = next;
    }
}

void clear_carried(const Group& group, std::uint32_t first, std::uint32_t limb_count)
{
    constexpr float zeros[kMaxComponents] = {};
    for (const FieldRow& row : kFields)
        if (row.kind == SWIVEL_FIELD_CARRIED && field_row_count(group.features, row.field) > 0)
            copy_in(rows_of(group, row.field), first, limb_count, {zeros, 0});
}

}  // namespace

size_t swivel_state_bytes(const swivel_crowd* crowd)
{
    return crowd && first_unequal_group(*crowd) == crowd->group_count ? state_layout(*crowd).bytes : 0;
}

swivel_status swivel_save(const swivel_crowd* crowd, uint32_t first_body, uint32_t body_count, void* bytes, size_t size)
{
    const Use use(crowd, Sharing::shared);
    swivel_status status = use.status;
    if (status == SWIVEL_OK) status = check_state(*crowd, first_body, body_count, bytes, size, "swivel_save");
    if (status != SWIVEL_OK) return status;
    const StateLayout layout = state_layout(*crowd);
    unsigned char* const states = static_cast<unsigned char*>(bytes);
    for (std::size_t n = 0; n < body_count; ++n) store_word(layout.word, states + n * layout.bytes);
    for_each_number(*crowd, first_body, body_count, states, layout.bytes,
                    [](const float& number, unsigned char* at) { store_word(bit_cast<std::uint32_t>(number), at); });
    return SWIVEL_OK;
}

swivel_status swivel_load(swivel_crowd* crowd, uint32_t first_body, uint32_t body_count, const void* bytes, size_t size)
{
    const Use use(crowd, Sharing::alone);
    swivel_status status = use.status;
    if (status == SWIVEL_OK) status = check_state(*crowd, first_body, body_count, bytes, size, "swivel_load");
    if (status != SWIVEL_OK) return status;
    const StateLayout layout = state_layout(*crowd);
    const unsigned char* const states = static_cast<const unsigned char*>(bytes);
    for (std::size_t n = 0; n < body_count; ++n)
        if (load_word(states + n * layout.bytes) != layout.word)
            return refuse("swivel_load: state %zu is of another kind of crowd; save it from one of the same groups", n);
    for_each_number(*crowd, first_body, body_count, states, layout.bytes,
                    [](float& number, const unsigned char* at) { number = bit_cast<float>(load_word(at)); });
    return SWIVEL_OK;
}

swivel_status swivel_reset(swivel_crowd* crowd, uint32_t group, uint32_t first, uint32_t limb_count)
{
    const Use use(crowd, Sharing::alone);
    if (const swivel_status status = use.for_limbs(group, first, limb_count); status != SWIVEL_OK) return status;
    clear_carried(crowd->groups[group], first, limb_count);
    crowd->reset_limbs.fetch_add(limb_count, std::memory_order_relaxed);
    return SWIVEL_OK;
}

swivel_status swivel_reset_body(swivel_crowd* crowd, uint32_t first_body, uint32_t body_count)
{
    const Use use(crowd, Sharing::alone);
    swivel_status status = use.status;
    if (status == SWIVEL_OK) status = check_bodies(*crowd, first_body, body_count, "swivel_reset_body");
    if (status != SWIVEL_OK) return status;
    for (std::uint32_t g = 0; g < crowd->group_count; ++g) clear_carried(crowd->groups[g], first_body, body_count);
    crowd->reset_limbs.fetch_add(body_count, std::memory_order_relaxed);
    return SWIVEL_OK;
}
