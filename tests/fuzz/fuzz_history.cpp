// A good history with changes at arbitrary places.
#include "solvers/hdf5/history.hpp"
#include "tests/fuzz/fuzz_hdf5.hpp"

namespace {

using namespace cardan;
using namespace cardan::solvers;

std::vector<Channel> two_channels() {
    return {{.name = "a", .units = "m", .long_name = "first"}, {.name = "b", .units = "N", .long_name = "second"}};
}

std::string good_history() {
    const auto path = fuzz::folder() / "good.h5";
    HistoryWriter writer = HistoryWriter::create(path, two_channels(), {.title = "t"}, {.replace = true, .chunk = 2});
    for (int row = 0; row < 40; ++row) writer.append(row, std::vector<double>{0.1 * row, -1.0 * row});
    writer.take_checkpoints([] {
        Checkpoint checkpoint;
        checkpoint.time = 39;
        checkpoint.q = checkpoint.qd = Vector::Ones(3);
        checkpoint.notes["note"] = 1;
        return checkpoint;
    });
    writer.finish();
    return fuzz::bytes_of(path);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::string good = good_history();
    const auto path = fuzz::with_changes(good, data, size);
    fuzz::try_it([&] { (void)read_history_info(path); });
    fuzz::try_it([&] { (void)read_history(path); });
    fuzz::try_it([&] { (void)read_history(path, {{"b"}, 3, 30}); });
    fuzz::try_it([&] { (void)repair_history(path); });
    return fuzz::try_it([&] {
        HistoryWriter writer = HistoryWriter::append_to(path, two_channels());
        writer.append(writer.last_time() + 1, std::vector<double>{1, 2});
        writer.finish();
    });
}
