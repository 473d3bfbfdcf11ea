/// @file
/// Additions to a model beside its file.
#pragma once

#include <string>

namespace cardan::turbines {

/// Entries in the format and under the keys of the model: those that it lacks, or others in the place of its own. Maps
/// are merged key by key, everything else is replaced.
struct ModelAddition {
    std::string text;
    std::string name;  ///< of the file, for messages
};

}  // namespace cardan::turbines
