// An input of triples (place, place, byte) changes a good history at these places; one that begins as an HDF5 file does
// is taken as it is.
#include "solvers/hdf5/history.hpp"
#include "tests/fuzz/fuzz.hpp"

#include <iterator>

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
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

// HDF5 1.10 itself loses some bytes when a header that it reads is damaged.
extern "C" const char* __asan_default_options() {  // NOLINT(bugprone-reserved-identifier): the sanitizer's name
    return "detect_leaks=0";
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::string good = good_history();
    std::string bytes = good;
    if (fuzz::text_of(data, size).starts_with("\x89HDF"))
        bytes = fuzz::text_of(data, size);
    else
        for (std::size_t i = 0; i + 2 < size; i += 3)
            bytes[(data[i] * 256U + data[i + 1]) % bytes.size()] = static_cast<char>(data[i + 2]);
    const auto path = fuzz::folder() / "a.h5";
    fuzz::write(path, bytes);
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
