#include "mbs/model/coordinates.hpp"

#include "mbs/base/error.hpp"

#include <algorithm>

namespace cardan {

int CoordinateTable::index(std::string_view name) const {
    for (int i = 0; i < size(); ++i)
        if ((*this)[i].name == name) return i;
    std::string known;
    for (int i = 0; i < std::min(size(), 12); ++i) known += text(i ? ", '" : "'", (*this)[i].name, "'");
    throw InputError(text("unknown coordinate '", name, "'; the model has ", size(), " coordinates: ", known,
                          size() > 12 ? ", ..." : ""));
}

Vector CoordinateTable::vector(std::initializer_list<NamedNumber> named) const {
    Vector all = Vector::Zero(size());
    std::vector<bool> given(rows_.size());
    for (const NamedNumber& one : named) {
        const int at = index(one.coordinate);
        if (entry(given, at)) throw InputError(text("coordinate '", one.coordinate, "' is given twice"));
        entry(given, at) = true;
        all(at) = one.value;
    }
    return all;
}

std::vector<int> CoordinateTable::free() const {
    std::vector<int> indices;
    for (int i = 0; i < size(); ++i)
        if ((*this)[i].role == CoordinateRole::free) indices.push_back(i);
    return indices;
}

std::vector<int> CoordinateTable::free_without(int index) const {
    std::vector<int> indices = free();
    std::erase(indices, index);
    return indices;
}

std::vector<bool> CoordinateTable::driven() const {
    std::vector<bool> flags;
    for (const CoordinateInfo& row : rows_) flags.push_back(row.role == CoordinateRole::prescribed);
    return flags;
}

std::vector<std::string> CoordinateTable::parts() const {
    std::vector<std::string> names;
    for (const CoordinateInfo& row : rows_)
        if (std::find(names.begin(), names.end(), row.part) == names.end()) names.push_back(row.part);
    return names;
}

std::vector<int> CoordinateTable::of_part(std::string_view part, int blade) const {
    std::vector<int> indices;
    for (int i = 0; i < size(); ++i)
        if ((*this)[i].part == part && (blade == 0 || (*this)[i].blade == blade)) indices.push_back(i);
    return indices;
}

}  // namespace cardan
