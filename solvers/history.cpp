#include "solvers/history.hpp"

#include "mbs/error.hpp"

namespace cardan::solvers {

std::size_t History::index(std::string_view channel) const {
    std::string known;
    for (std::size_t i = 0; i < channels.size(); ++i) {
        if (channels[i].name == channel || (!channel.empty() && channels[i].alias == channel)) return i;
        if (i < 12) known += text(i == 0 ? "" : ", ", "'", channels[i].name, "'");
    }
    if (channels.size() > 12) known += text(" ... (", channels.size(), " in all)");
    throw InputError(text("history '", title, "'"), "channel", text("'", channel, "'"), text("one of ", known));
}

}  // namespace cardan::solvers
