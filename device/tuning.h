// SPDX-License-Identifier: MIT
//
// Numbers that kernels are cut up by, and what they are on one device.
//
//     a part of a room declares a Parameter  ──►  Device::tuned(parameter)  ──►  a kernel's define, a launch's size
//                                                       ▲
//                              Tuning: what `bvhbench tune` found for this device, if it did
//
// No value may change an answer: a parameter says how work is cut up and never what is done.
#pragma once

#include <array>
#include <bit>
#include <cassert>
#include <initializer_list>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "geometry/dialect.h"

namespace bvhbench {

/// The values that a search tries, up to eight.
class CandidateValues {
public:
    constexpr CandidateValues(std::initializer_list<uint> values)
    {
        assert(values.size() <= values_.size());
        for (const uint value : values)
            values_[count_++] = value;
    }
    constexpr const uint* begin() const { return values_.data(); }
    constexpr const uint* end() const { return values_.data() + count_; }

private:
    std::array<uint, 8> values_{};
    uint count_ = 0;
};

/// What values of a parameter there can be, besides its range.
enum class ValueIs {
    any_number,
    odd,
    power_of_two,
    group_size
};  ///< a group size is a power of two, too

/// A number that a part lets a device choose. Declared once, in its room's `parameters.h`.
struct Parameter {
    std::string_view name;     ///< "sort.keys_per_item"; unique, stable, the key in tuning files
    std::string_view meaning;  ///< one line, with what 0 stands for if it may be 0
    std::string_view stage;    ///< whose time it is judged by; empty: all stages together
    uint on_cpu = 0;           ///< the default of devices with a few fast cores
    uint elsewhere = 0;        ///< and of the others
    uint least = 0, most = 0;
    ValueIs values = ValueIs::any_number;
    CandidateValues candidates;

    constexpr uint usual(bool is_cpu) const { return is_cpu ? on_cpu : elsewhere; }

    /// Why it cannot be `value`, as the end of a sentence, "must be odd, not 4"; empty if it can. A power of two may be
    /// 0 where `least` is.
    std::string refusal(uint value) const
    {
        const std::string but = ", not " + std::to_string(value);
        if (value < least || value > most)
            return "must be from " + std::to_string(least) + " to " + std::to_string(most) + but;
        if (values == ValueIs::odd && value % 2 == 0)
            return "must be odd" + but;
        const bool is_power = values == ValueIs::power_of_two || values == ValueIs::group_size;
        if (is_power && value != 0 && !std::has_single_bit(value))
            return "must be a power of two" + but;
        return {};
    }
};

/// Values that take the place of defaults, and which parameters anybody has asked for.
class Tuning {
public:
    Tuning() = default;
    explicit Tuning(std::string origin) : origin_(std::move(origin)) {}

    /// Where values come from, for people and result files: "none", or a file.
    const std::string& origin() const { return origin_; }

    void set(const Parameter& parameter, uint value) { values_[parameter.name] = value; }
    void unset(const Parameter& parameter) { values_.erase(parameter.name); }
    bool has(const Parameter& parameter) const { return values_.contains(parameter.name); }

    /// The value set, else the default.
    uint value(const Parameter& parameter, bool is_cpu) const
    {
        asked_.insert(&parameter);
        const auto found = values_.find(parameter.name);
        return found != values_.end() ? found->second : parameter.usual(is_cpu);
    }

    /// All values set, by parameters' names.
    const std::map<std::string_view, uint>& values() const { return values_; }

    /// Parameters whose value anybody has asked for: what a builder or collider depends on need not be written down.
    const std::set<const Parameter*>& asked() const { return asked_; }

private:
    std::string origin_ = "none";
    std::map<std::string_view, uint>
        values_;  ///< names are parameters', which live as long as the program
    mutable std::set<const Parameter*> asked_;
};

}  // namespace bvhbench
