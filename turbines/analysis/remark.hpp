/// @file
/// Remarks of an analysis beside its result.
#pragma once

#include "turbines/readers/turbine_file.hpp"

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace cardan::turbines {

struct Remark {
    enum class Kind : std::uint8_t {
        taken,       ///< a value that was not given, or how something is modelled, and from where that is
        note,        ///< an approximation, or something left out
        warning,     ///< of the assembly, or of an operating point that has no state
        controller,  ///< what a controller says, or demands in vain, at a time of the run
        file         ///< entries of a file that are not used, or used otherwise: `entries`
    };
    Kind kind = Kind::note;
    std::string text;
    double time = 0;                     ///< of a controller, s
    std::vector<FileNote> entries = {};  ///< of a file
};

/// Receives remarks when they arise; empty: nobody does.
using Report = std::function<void(const Remark&)>;

inline void report_remark(const Report& report, const Remark& remark) {
    if (report) report(remark);
}

/// Keeps all remarks, and passes them on.
/// @param all  lives as long as the report
inline Report kept(std::vector<Remark>& all, Report further) {
    return [&all, further = std::move(further)](const Remark& remark) {
        all.push_back(remark);
        report_remark(further, remark);
    };
}

}  // namespace cardan::turbines
