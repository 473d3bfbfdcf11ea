#include "elements/wind/box_files.hpp"

#include "mbs/base/error.hpp"

#include <cstdint>
#include <utility>

namespace cardan {

std::function<void()> change_guard(BoxFiles files) {
    std::vector<std::int64_t> written;
    written.reserve(files.size());
    for (const auto& file : files) written.push_back(file->written());
    return [files = std::move(files), written = std::move(written)] {
        for (std::size_t i = 0; i < files.size(); ++i) {
            files[i]->require_whole();
            if (files[i]->written() != written[i])
                throw FileError(files[i]->path(),
                                "was written to while a run was in it; what came of that is not of "
                                "the wind that the run names");
        }
    };
}

}  // namespace cardan
