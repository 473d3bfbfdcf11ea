// Kinds of wind files that no file of tests/data/wind is of: the same numbers under another header, in another order,
// or with something left out; and the memory that they take.
#include "tests/support/allocation_guard.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/process_memory.hpp"
#include "tests/turbines/readers/wind_box_bytes.hpp"
#include "tests/turbines/readers/wind_box_files.hpp"
#include "turbines/readers/bladed_box.hpp"
#include "turbines/readers/turbsim_box.hpp"

namespace cardan::testing::wind_box_layout_tests {

namespace {

using namespace turbines;
using test::Bytes;

constexpr std::size_t header = 104;  // of nrel.wnd: 5 x 4 points, 16 planes

class BoxFolder : public test::ModelFolder {
public:
    BoxFolder() : ModelFolder("wind") {}
    [[nodiscard]] std::string numbers() const { return test::bytes_of(*this / "nrel.wnd").substr(header); }
    [[nodiscard]] WindBoxFile read(const std::string& wnd) const {
        write("nrel.wnd", wnd);
        return read_bladed_box(*this / "nrel.wnd");
    }
};

// The grid in a header of kind -99.
std::string grid_of(bool three) {
    Bytes out;
    out.add(20.F, 15.F, 5.F, 8, 10.F, 1.F, 2.F, 3.F, 0, 7, 4, 5);
    if (three) out.add(1.F, 2.F, 3.F, 4.F, 5.F, 6.F);
    return out.all;
}

void check_same(const WindBox& a, const WindBox& b, bool three = true) {
    CHECK(a.grid() == b.grid());
    double largest = 0;
    for (int t = 0; t < a.grid().steps; ++t)
        for (int k = 0; k < a.grid().rows; ++k)
            for (int j = 0; j < a.grid().columns; ++j) {
                const Vec3 d = a.at_point(t, k, j) - b.at_point(t, k, j);
                largest = std::max(largest, three ? d.norm() : std::abs(d.x()));
            }
    CHECK(largest < 2e-6);  // intensities of four digits in the summary
}

}  // namespace

TEST_CASE("wind boxes: one box under all headers of Bladed's kind", "[property]") {
    const BoxFolder folder;
    // Without intensities those of the summary count, which are given with as many digits here.
    const std::string numbers = folder.numbers(), as_it_is = test::bytes_of(folder / "nrel.wnd");
    float intensities[3];
    std::memcpy(intensities, as_it_is.data() + 20, sizeof intensities);
    folder.replace("nrel.sum", "1.5231 %", text(intensities[0], " %"));
    folder.replace("nrel.sum", "1.0471 %", text(intensities[1], " %"));
    folder.replace("nrel.sum", "0.6955 %", text(intensities[2], " %"));
    const WindBoxFile reference = read_bladed_box(test::wind_file("nrel.wnd"));
    CHECK(reference.mean.reference_height == 70);
    CHECK(reference.mean.speed == 0);
    const auto id = [](std::int16_t kind) { return Bytes().add(std::int16_t{-99}, kind).all; };
    const std::string counts = Bytes().add(0, 3).all;  // size of the header, components
    check_same(*folder.read(id(3) + grid_of(true) + numbers).box, *reference.box);
    check_same(*folder.read(id(5) + grid_of(true) + numbers).box, *reference.box);
    check_same(*folder.read(id(7) + counts + grid_of(true) + std::string(8, '\0') + numbers).box, *reference.box);
    check_same(*folder.read(id(8) + counts + grid_of(true) + std::string(64, '\0') + numbers).box, *reference.box);
    Bytes old;
    for (const int one : {-3, 20000, 15000, 5000, 8, 100, 1, 2, 3, 0, 7, 4000, 5000, 1, 2, 3, 4, 5, 6})
        old.add(static_cast<std::int16_t>(one));
    check_same(*folder.read(old.all + numbers).box, *reference.box);

    std::string u;
    for (std::size_t i = 0; i < numbers.size(); i += 6) u += numbers.substr(i, 2);
    for (const std::string& kind : {id(1), id(2)}) {
        const WindBoxFile alone = folder.read(kind + grid_of(false) + u);
        check_same(*alone.box, *reference.box, false);
        CHECK(alone.box->at_point(3, 2, 1).tail<2>().isZero(0));
    }
    std::string uv;
    for (std::size_t i = 0; i < numbers.size(); i += 6) uv += numbers.substr(i, 4);
    old.all.resize(26);
    old.put(0, std::int16_t{-2});
    const WindBoxFile two = folder.read(old.all + uv);
    CHECK(std::abs(two.box->at_point(3, 2, 1).y() - reference.box->at_point(3, 2, 1).y()) < 2e-6);
    CHECK(two.box->at_point(3, 2, 1).z() == 0);
    old.put(0, std::int16_t{-1});
    check_same(*folder.read(old.all + u).box, *reference.box, false);
}

TEST_CASE("wind boxes: an odd number of planes, which headers of Bladed's kind halve", "[property]") {
    const BoxFolder folder;
    const std::string as_it_is = test::bytes_of(folder / "nrel.wnd");
    const WindBoxFile odd = folder.read(as_it_is + as_it_is.substr(header, 120));
    CHECK(odd.box->grid().steps == 17);
    CHECK(odd.box->at_point(16, 3, 4) == odd.box->at_point(0, 3, 4));
}

TEST_CASE("wind boxes: what a summary says, or leaves out, of a box of Bladed's kind", "[property]") {
    const BoxFolder folder;
    const std::string as_it_is = test::bytes_of(folder / "nrel.wnd"), summary = test::bytes_of(folder / "nrel.sum");
    const WindBoxFile reference = folder.read(as_it_is);
    CHECK(reference.notes.empty());
    CHECK(reference.box->data().periodic);
    const auto with = [&](const std::string& from, const std::string& to) {
        folder.write("nrel.sum", summary);
        folder.replace("nrel.sum", from, to);
        return folder.read(as_it_is);
    };
    const WindBox &box = *reference.box, ahead = *with("PERIODIC", "other").box,
                  right = *with("LEFT-HAND", "other").box, plain = *with("T  CLOCK", "F  CLOCK").box,
                  no = *with("T  CLOCKWISE", "No - clockwise").box, lower = *with("OFFSET = 0", "OFFSET = 5").box;
    CHECK(!ahead.data().periodic);
    CHECK(ahead.data().start == 30);
    for (int j = 0; j < 5; ++j) {
        const Vec3 is = box.at_point(2, 1, j);
        CHECK(right.at_point(2, 1, j) == Vec3(is.x(), -is.y(), is.z()));
        CHECK(plain.at_point(2, 1, 4 - j) == is);
        CHECK(no.at_point(2, 1, 4 - j) == is);
    }
    CHECK(lower.grid().lowest == box.grid().lowest - 5);
    CHECK(test::has_note(with("1.5231", "9").notes, "TI(u)", "that of the .wnd counts, 1.523"));
}

TEST_CASE("wind boxes: points of the tower in a file of their own", "[property]") {
    const BoxFolder folder;
    Bytes tower;  // two points of 16 planes
    tower.add(20.F, 5.F, 40.F, 16, 2, 10.F, 10.F, 20.F, 5.F);
    for (std::int16_t i = 0; i < 16 * 2 * 3; ++i) tower.add(static_cast<std::int16_t>(100 * i));
    folder.write("nrel.twr", tower.all);
    const WindBoxFile file = read_bladed_box(folder / "nrel.wnd", TowerFile::beside);
    // As InflowWind's reader scales them: V + V TI q 1e-5, TI in %; here of plane 3 at t = 1.5 s, point 0 and half-way.
    const Vec3 first(10 + 1e-3 * 1800, 2e-3 * 1900, 0.5e-3 * 2000), second = first + Vec3(0.3, 0.6, 0.15);
    CHECK((file.box->at({0, 4, 39.9}, 1.5) - (first + 0.005 * (second - first))).norm() < 1e-12);
    CHECK((file.box->at({0, -9, 30}, 1.5) - (first + second) / 2).norm() < 1e-12);
    CHECK((file.box->at({0, 0, 10}, 1.5) - second / 2).norm() < 1e-12);
    CHECK(file.box->data().origin.files.size() == 3);
    const auto refused = [&] {
        return test::message_of([&] { read_bladed_box(folder / "nrel.wnd", TowerFile::beside); });
    };
    for (const auto& [at, value, part] : {std::tuple(0, 19.F, "byte 0: distance of points [m] = 19"),
                                          {4, 6.F, "byte 4: distance of planes [m] = 6"},
                                          {8, 60.F, "byte 8: height of the highest point [m] = 60"},
                                          {20, 11.F, "byte 20: mean wind speed [m/s] = 11"},
                                          {28, std::nanf(""), "byte 28: intensity [%] = nan"}}) {
        Bytes other = tower;
        other.put(static_cast<std::size_t>(at), value);
        folder.write("nrel.twr", other.all);
        CAPTURE(part);
        CHECK(refused().find(part) != std::string::npos);
    }
    folder.write("nrel.twr", tower.all.substr(0, tower.all.size() - 1));
    CHECK(refused().find("it is cut") != std::string::npos);
    std::filesystem::remove(folder / "nrel.twr");
    CHECK(refused().find("nrel.twr: cannot be read") != std::string::npos);
}

TEST_CASE("wind boxes: below the grid, beside it and behind its planes there is only what the file has", "[property]") {
    const auto refused = [](const WindBoxFile& file, const Vec3& place, double time) {
        return test::message_of([&] { static_cast<void>(file.box->at(place, time)); });
    };
    const WindBoxFile bare = read_turbsim_box(test::wind_file("box8_notower.bts")),
                      aperiodic = read_turbsim_box(test::wind_file("box7.bts"));
    CHECK(refused(bare, {0, 0, 39}, 0).find("height") != std::string::npos);
    CHECK(refused(bare, {0, 0, 101}, 0).find("height") != std::string::npos);
    CHECK(refused(bare, {0, 31, 70}, 0).find("across") != std::string::npos);
    // Its first plane is half of 60 m upwind, 3 s at 10 m/s; 16 planes are 7.5 s.
    CHECK_NOTHROW(aperiodic.box->at({0, 0, 70}, -3));
    CHECK(refused(aperiodic, {0, 0, 70}, -3.1).find("time in the box") != std::string::npos);
    CHECK_NOTHROW(aperiodic.box->at({0, 0, 70}, 4.5));
    CHECK(refused(aperiodic, {0, 0, 70}, 4.6).find("time in the box") != std::string::npos);
}

TEST_CASE("wind boxes: a long file is read without taking its place in memory", "[property]") {
    const test::Folder folder;
    Hawc2Box box = test::hawc2_box_in(folder.path.string());
    box.planes = 4096;
    box.rows = box.columns = 32;
    for (const auto& path : box.files) {
        std::ofstream{path};
        std::filesystem::resize_file(path, std::uintmax_t{4096} * 32 * 32 * 4);  // 16 MiB of zeros
    }
    const long before = test::anonymous_memory();
    const WindBoxFile file = read_hawc2_box(box);
    // A sanitizer keeps what has been freed.
    if (AllocationGuard::works()) CHECK(test::anonymous_memory() - before < 4096);
    CHECK(file.box->at({0, 0, 70}, 100).isZero(0));
}

}  // namespace cardan::testing::wind_box_layout_tests
