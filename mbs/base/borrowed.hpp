/// @file
/// Memory that functions without state of their own use again and again.
#pragma once

#include <utility>

namespace cardan {

/// A T of this thread, as its last borrower left it. Who borrows while it is lent gets a fresh one.
template <class T>
class Borrowed {
public:
    Borrowed() : own_(std::move(kept())) {}
    ~Borrowed() { kept() = std::move(own_); }
    Borrowed(const Borrowed&) = delete;
    Borrowed& operator=(const Borrowed&) = delete;
    T& operator*() { return own_; }
    T* operator->() { return &own_; }

private:
    static T& kept() {
        thread_local T memory;
        return memory;
    }
    T own_;
};

}  // namespace cardan
