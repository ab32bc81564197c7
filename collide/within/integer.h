// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace bvhbench {

/// An integer of any size. It is our own because the library needs no package but OpenCL's (tests/library/alone_test.py).
class Integer {
public:
    Integer() = default;

    /// The double `value` in units of 2^unit, which must divide it.
    explicit Integer(double value, int unit = 0) : is_negative_(value < 0)
    {
        int exponent = 0;
        auto digits =
            static_cast<std::uint64_t>(std::ldexp(std::frexp(std::fabs(value), &exponent), 53));
        if (digits == 0)
            return;
        int shift = exponent - 53 - unit;
        for (; shift < 0; ++shift)
            digits /= 2;
        words_.assign(static_cast<std::size_t>(shift / 32), 0);
        const int bits = shift % 32;
        const std::uint64_t low = digits << bits, high = bits > 0 ? digits >> (64 - bits) : 0;
        for (const std::uint64_t word : {low, low >> 32, high})
            words_.push_back(static_cast<std::uint32_t>(word));
        trim();
    }

    /// Returns m and e: the number is m times 2^e, up to 2^-51 of it.
    std::pair<double, int> rounded() const
    {
        double digits = 0;
        const std::size_t used = std::min<std::size_t>(words_.size(), 3);
        for (std::size_t k = 0; k < used; ++k)
            digits = digits * 0x1p32 + words_[words_.size() - 1 - k];
        return {is_negative_ ? -digits : digits, 32 * static_cast<int>(words_.size() - used)};
    }

    int sign() const { return words_.empty() ? 0 : is_negative_ ? -1 : 1; }

    Integer operator-() const
    {
        Integer other = *this;
        other.is_negative_ = !is_negative_;
        return other;
    }

    friend Integer operator+(const Integer& a, const Integer& b)
    {
        if (a.words_.size() < b.words_.size())
            return b + a;
        const bool adds = a.is_negative_ == b.is_negative_;
        Integer sum = a;
        sum.words_.push_back(0);
        std::int64_t carry = 0;
        for (std::size_t k = 0; k < sum.words_.size(); ++k) {
            const std::int64_t other = k < b.words_.size() ? b.words_[k] : 0;
            carry += std::int64_t{sum.words_[k]} + (adds ? other : -other);
            sum.words_[k] = static_cast<std::uint32_t>(carry);
            carry >>= 32;
        }
        if (carry < 0)  // b was larger: the words are those of 2^n less the difference
            sum.complement();
        sum.trim();
        return sum;
    }
    friend Integer operator-(const Integer& a, const Integer& b) { return a + -b; }

    friend Integer operator*(const Integer& a, const Integer& b)
    {
        Integer product;
        product.is_negative_ = a.is_negative_ != b.is_negative_;
        product.words_.assign(a.words_.size() + b.words_.size(), 0);
        for (std::size_t i = 0; i < a.words_.size(); ++i) {
            std::uint64_t carry = 0;
            for (std::size_t j = 0; j < b.words_.size(); ++j) {
                carry += product.words_[i + j] + std::uint64_t{a.words_[i]} * b.words_[j];
                product.words_[i + j] = static_cast<std::uint32_t>(carry);
                carry >>= 32;
            }
            product.words_[i + b.words_.size()] = static_cast<std::uint32_t>(carry);
        }
        product.trim();
        return product;
    }
    friend bool operator<=(const Integer& a, const Integer& b) { return (a - b).sign() <= 0; }

private:
    void complement()
    {
        std::uint64_t carry = 1;
        for (std::uint32_t& word : words_) {
            carry += static_cast<std::uint32_t>(~word);
            word = static_cast<std::uint32_t>(carry);
            carry >>= 32;
        }
        is_negative_ = !is_negative_;
    }

    void trim()
    {
        while (!words_.empty() && words_.back() == 0)
            words_.pop_back();
    }

    std::vector<std::uint32_t> words_;  ///< of the size, least first; the last is not 0
    bool is_negative_ = false;
};

}  // namespace bvhbench
