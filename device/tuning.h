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

/// A number whose value depends on the device. Declared once, in its room's `parameters.h`.
struct Parameter {
    std::string_view name;     ///< unique and stable key in tuning files, as "sweep.keys_per_item"
    std::string_view meaning;  ///< one line of description; says what 0 means if 0 is allowed
    std::string_view stage;    ///< the stage whose time tuning minimizes; empty: all stages
    uint on_cpu = 0;           ///< default on CPUs
    uint elsewhere = 0;        ///< default on all other devices
    uint least = 0, most = 0;  ///< range, both ends included
    bool is_group_size = false;  ///< a power of two that the device allows as the size of a group
    CandidateValues candidates;

    constexpr uint usual(bool is_cpu) const { return is_cpu ? on_cpu : elsewhere; }

    /// Returns why `value` is not allowed, as the end of a sentence ("must be a power of two, not 96"), or an empty string if it is. A
    /// power of two may be 0 if `least` is 0.
    std::string refusal(uint value) const
    {
        const std::string but = ", not " + std::to_string(value);
        if (value < least || value > most)
            return "must be from " + std::to_string(least) + " to " + std::to_string(most) + but;
        if (is_group_size && value != 0 && !std::has_single_bit(value))
            return "must be a power of two" + but;
        return {};
    }
};

/// Values that a parameter may have.
struct ParameterRange {
    uint least, most;
    bool is_group_size = false;
};

/// Returns a parameter with the default `usual` on every kind of device.
constexpr Parameter usually(uint usual, std::string_view name, std::string_view stage,
                            std::string_view meaning, ParameterRange range,
                            const CandidateValues& candidates)
{
    return {name,      meaning, stage, usual, usual, range.least, range.most, range.is_group_size,
            candidates};
}

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
