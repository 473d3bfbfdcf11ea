/// @file
/// Iterates over the symbols of a packed table: for (auto [a, b, c, value] : gamma.symbols()).
#pragma once

#include "mbs/kernels/christoffel.hpp"

#include <cstddef>
#include <iterator>

namespace cardan {

/// One symbol Gamma_abc = Gamma_acb with b <= c.
struct ChristoffelSymbol {
    int a, b, c;
    double value;
};

/// All symbols Gamma_abc with b <= c of a tree that do not vanish for every q, each exactly once, a anywhere.
///
/// Structural zeros are skipped: a, b and c not on one path; b prismatic, where b is the one of b and c nearer the
/// base, unless the most distal of the three carries added mass; a = c (Gamma_cbc is half the derivative of g_cc by a
/// joint that carries c). A symbol that is zero only at this q is visited. The order is that of the table: by the most
/// distal of the three, then by row.
///
/// A forward range of values, valid as long as the Christoffel object; the values are those at the time of reading.
class ChristoffelSymbols {
public:
    class Iterator {
    public:
        using iterator_concept = std::forward_iterator_tag;
        using iterator_category = std::input_iterator_tag;  // of C++17, where a reference must be one
        using value_type = ChristoffelSymbol;
        using difference_type = std::ptrdiff_t;
        using reference = ChristoffelSymbol;
        using pointer = void;

        Iterator() = default;
        Iterator(const Christoffel& gamma, int m) : gamma_(&gamma), m_(m) {
            enter();
            settle();
        }

        ChristoffelSymbol operator*() const {
            const double K = table_[row_ * gamma_->stride(m_) + column_];
            if (mirrored_) return {m_, path_[column_], path_[row_], -K};
            return {path_[row_], path_[column_], m_, K};
        }
        Iterator& operator++() {
            // K_m(a, b) stands for Gamma_abm and, if b <= a < m, for -Gamma_mba.
            mirrored_ = !mirrored_ && column_ <= row_;
            if (mirrored_) return *this;
            ++column_;
            settle();
            return *this;
        }
        Iterator operator++(int) {
            Iterator before = *this;
            ++*this;
            return before;
        }
        friend bool operator==(const Iterator& x, const Iterator& y) {
            return x.gamma_ == y.gamma_ && x.m_ == y.m_ && x.row_ == y.row_ && x.column_ == y.column_ &&
                   x.mirrored_ == y.mirrored_;
        }

    private:
        void enter() {
            row_ = column_ = 0;
            if (m_ >= gamma_->model().size()) return;
            path_ = gamma_->path(m_);
            table_ = gamma_->table(m_);
            entrains_ = gamma_->model().entrains(m_);
        }
        // Advances to the next entry that is not a structural zero, possibly the present one.
        void settle() {
            const Model& model = gamma_->model();
            while (m_ < model.size()) {
                for (; row_ + 1 < path_.size(); ++row_, column_ = 0)
                    for (; column_ < path_.size(); ++column_)
                        if (entrains_ || model.body(path_[column_]).revolute) return;
                ++m_;
                enter();
            }
        }

        const Christoffel* gamma_ = nullptr;
        std::span<const int> path_ = {};
        std::span<const double> table_ = {};
        int m_ = 0;
        std::size_t row_ = 0, column_ = 0;
        bool mirrored_ = false, entrains_ = false;
    };

    explicit ChristoffelSymbols(const Christoffel& gamma) : gamma_(&gamma) {}
    Iterator begin() const { return {*gamma_, 0}; }
    Iterator end() const { return {*gamma_, gamma_->model().size()}; }

private:
    const Christoffel* gamma_;
};

inline ChristoffelSymbols Christoffel::symbols() const {
    return ChristoffelSymbols(*this);
}

}  // namespace cardan
