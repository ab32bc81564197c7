// SPDX-License-Identifier: MIT
//
// Tuning parameters, which say how kernels divide their work, and their values on one device.
//
//     a part of a room declares a Parameter  ──►  Device::tuned(parameter)  ──►  a kernel's define, a launch's size
//                                                       ▲
//                              Tuning: values that `bvhbench tune` found for this device, if any
//
// No value may change a result: a parameter determines how work is divided, never what is computed.
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

/// Values that the tuning search tries, at most eight.
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

/// Constraint on a parameter's values besides its range. A group size must also be a power of two.
enum class ValueIs { any_number, odd, power_of_two, group_size };

/// A number whose value depends on the device. Declared once, in its room's `parameters.h`.
struct Parameter {
    std::string_view name;     ///< unique and stable key in tuning files, as "sort.keys_per_item"
    std::string_view meaning;  ///< one line of description; says what 0 means if 0 is allowed
    std::string_view stage;    ///< the stage whose time tuning minimizes; empty: all stages
    uint on_cpu = 0;           ///< default on CPUs
    uint elsewhere = 0;        ///< default on all other devices
    uint least = 0, most = 0;  ///< range, both ends included
    ValueIs values = ValueIs::any_number;
    CandidateValues candidates;

    constexpr uint usual(bool is_cpu) const { return is_cpu ? on_cpu : elsewhere; }

    /// Returns why `value` is not allowed, as the end of a sentence ("must be odd, not 4"), or an empty string if it is. A
    /// power of two may be 0 if `least` is 0.
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

/// Values that replace defaults. Also records which parameters have been read.
class Tuning {
public:
    Tuning() = default;
    explicit Tuning(std::string origin) : origin_(std::move(origin)) {}

    /// Returns where the values come from, "none" or a file, for output and result files.
    const std::string& origin() const { return origin_; }

    void set(const Parameter& parameter, uint value) { values_[parameter.name] = value; }
    void unset(const Parameter& parameter) { values_.erase(parameter.name); }
    bool has(const Parameter& parameter) const { return values_.contains(parameter.name); }

    /// Returns the value that was set, else the default. Records that the parameter was read.
    uint value(const Parameter& parameter, bool is_cpu) const
    {
        asked_.insert(&parameter);
        const auto found = values_.find(parameter.name);
        return found != values_.end() ? found->second : parameter.usual(is_cpu);
    }

    /// Returns all values that were set, by parameter name.
    const std::map<std::string_view, uint>& values() const { return values_; }

    /// Returns the parameters that have been read. So the parameters of a builder or collider need not be listed anywhere.
    const std::set<const Parameter*>& asked() const { return asked_; }

private:
    std::string origin_ = "none";
    std::map<std::string_view, uint> values_;  ///< keys refer to Parameter::name, which are static
    mutable std::set<const Parameter*> asked_;
};

}  // namespace bvhbench
