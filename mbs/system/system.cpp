#include "mbs/system/system.hpp"

#include "mbs/base/error.hpp"

namespace cardan {

void System::refuse_loops(const char* where) const {
    throw InputError(where, "loop", loops.describe(0),
                     "none: this analysis knows trees only; time integration, steady states, linearisation and natural "
                     "modes know loops");
}

}  // namespace cardan
