#include "mbs/system/states.hpp"

#include "mbs/base/error.hpp"

#include <algorithm>

namespace cardan {

namespace {

constexpr const char* kind_of(const StateInfo*) {
    return "state";
}
constexpr const char* kind_of(const InputInfo*) {
    return "input";
}

}  // namespace

template <class Info>
int NamedTable<Info>::find(std::string_view name) const {
    const auto at = std::ranges::find(rows_, name, &Info::name);
    return at == rows_.end() ? -1 : static_cast<int>(at - rows_.begin());
}

template <class Info>
int NamedTable<Info>::index(std::string_view name) const {
    if (const int at = find(name); at >= 0) return at;
    constexpr int shown = 12;
    std::string known;
    for (int i = 0; i < std::min(size(), shown); ++i) known += text(i ? ", '" : "'", (*this)[i].name, "'");
    const char* kind = kind_of(static_cast<const Info*>(nullptr));
    throw InputError(text("unknown ", kind, " '", name, "'; the system has ", size(), " ", kind, "s",
                          size() > 0 ? ": " : "", known, size() > shown ? ", ..." : ""));
}

template <class Info>
Vector NamedTable<Info>::initial() const {
    Vector values(size());
    for (int i = 0; i < size(); ++i) values(i) = (*this)[i].initial;
    return values;
}

template class NamedTable<StateInfo>;
template class NamedTable<InputInfo>;

}  // namespace cardan
