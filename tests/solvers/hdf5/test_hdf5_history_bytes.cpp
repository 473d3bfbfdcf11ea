// Histories in which one byte was changed: read as they were, or refused, but never wrong, and never the end of the
// program that reads them.
#include "mbs/base/error.hpp"
#include "solvers/hdf5/history.hpp"
#include "tests/solvers/signals/history_rows.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"

#include <iostream>
#include <new>
#include <sys/mman.h>
#include <sys/wait.h>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::test;

namespace {

struct Change {
    std::size_t at;
    unsigned char by;  // exclusive or
};

struct Survival {
    std::size_t as_it_was = 0, refused = 0;
    std::string wrong, ended;  // places of the first few
};

// In memory that a child process shares.
struct Progress {
    std::size_t next = 0, as_it_was = 0, refused = 0, wrong = 0;
    std::size_t wrong_at[8] = {};
};

class Campaign {
public:
    Campaign(std::string path, std::size_t rows) : path_(std::move(path)), good_(bytes_of(path_)), rows_(rows) {
        void* memory = ::mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
        REQUIRE(memory != MAP_FAILED);
        progress_ = new (memory) Progress;
    }
    Campaign(const Campaign&) = delete;
    Campaign& operator=(const Campaign&) = delete;
    ~Campaign() { ::munmap(progress_, sizeof(Progress)); }

    [[nodiscard]] std::size_t size() const { return good_.size(); }

    // A child goes through the changes; where it ends, another goes on behind that place.
    Survival run(const std::vector<Change>& changes) {
        Survival outcome;
        while (progress_->next < changes.size()) {
            const pid_t child = ::fork();
            if (child == 0) {
                for (; progress_->next < changes.size(); ++progress_->next) try_one(changes[progress_->next]);
                ::_exit(0);
            }
            int status = 0;
            ::waitpid(child, &status, 0);
            if (!WIFSIGNALED(status) && WEXITSTATUS(status) == 0) break;
            outcome.ended += text(changes[progress_->next].at, WIFSIGNALED(status) ? " by signal " : " with code ",
                                  WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status), ", ");
            ++progress_->next;
        }
        outcome.as_it_was = progress_->as_it_was;
        outcome.refused = progress_->refused;
        for (std::size_t i = 0; i < std::min<std::size_t>(progress_->wrong, 8); ++i)
            outcome.wrong += text(progress_->wrong_at[i], ", ");
        return outcome;
    }

private:
    void try_one(Change change) {
        constexpr unsigned patience = 20;  // s
        std::string bytes = good_;
        bytes[change.at] = static_cast<char>(static_cast<unsigned char>(bytes[change.at]) ^ change.by);
        std::ofstream(path_, std::ios::binary | std::ios::trunc) << bytes;
        ::alarm(patience);
        try {
            const bool right = as_written();
            (void)repair_history(path_);
            if (right && as_written())
                ++progress_->as_it_was;
            else if (progress_->wrong++ < 8)
                progress_->wrong_at[progress_->wrong - 1] = change.at;
        } catch (const FileError&) {
            ++progress_->refused;
        }
        ::alarm(0);
    }

    [[nodiscard]] bool as_written() const {
        const HistoryInfo info = read_history_info(path_);
        const History history = read_history(path_);
        bool same_channels = info.channels.size() == 2;
        for (std::size_t i = 0; i < info.channels.size(); ++i)
            same_channels = same_channels && info.channels[i].name == text("channel ", i) &&
                            info.channels[i].units == "m" && info.channels[i].long_name == text("number ", i) &&
                            history.channels.at(i).name == info.channels[i].name;
        return same_channels && info.rows == rows_ && whole(info) && info.finished && info.about.title == about.title &&
               info.about.description == about.description && info.about.method == about.method &&
               history.time.size() == rows_ && wrong_values(history) == 0;
    }

    std::string path_, good_;
    std::size_t rows_;
    Progress* progress_ = nullptr;
};

void write_small(const std::string& path, std::size_t rows, int chunk) {
    HistoryWriter writer = HistoryWriter::create(path, some_channels(2), about, {.chunk = chunk});
    append_rows(writer, 0, rows);
    writer.take_checkpoints([&] { return checkpoint_of(rows - 1); });
    writer.finish();
}

void check(const Survival& outcome, std::size_t changes) {
    CHECK(outcome.wrong == "");
    CHECK(outcome.ended == "");
    CHECK(outcome.as_it_was + outcome.refused == changes);
    CHECK(outcome.refused > changes / 10);
    CHECK(outcome.as_it_was > changes / 10);  // gaps, and what readers do not need
}

}  // namespace

TEST_CASE("history: one changed byte is noticed or does not matter", "[property][slow]") {
    const Folder folder;
    write_small(folder / "a.h5", 40, 16);
    Campaign campaign(folder / "a.h5", 40);
    std::vector<Change> changes;
    for (std::size_t at = 0; at < campaign.size(); at += 37) changes.push_back({at, 0xFF});
    check(campaign.run(changes), changes.size());
}

// All bits at once and one bit (each of the eight in turn, 7 and 8 having no factor in common); and a file whose index
// has two levels. Every place takes a processor 20 minutes.
TEST_CASE("history: one changed byte is noticed or does not matter, at every seventh place", "[property][slow]") {
    const Folder folder;
    const auto [rows, chunk] = GENERATE(std::pair<std::size_t, int>{40, 16}, std::pair<std::size_t, int>{150, 2});
    write_small(folder / "a.h5", rows, chunk);
    Campaign campaign(folder / "a.h5", rows);
    std::vector<Change> changes;
    for (std::size_t at = 0; at < campaign.size(); at += chunk == 16 ? 7 : 35) {
        changes.push_back({at, 0xFF});
        if (chunk == 16) changes.push_back({at, static_cast<unsigned char>(1U << (at % 8))});
    }
    const Survival outcome = campaign.run(changes);
    std::cout << changes.size() << " changes of one byte in " << campaign.size() << ": " << outcome.refused
              << " refused, " << outcome.as_it_was << " without effect" << std::endl;
    check(outcome, changes.size());
}
