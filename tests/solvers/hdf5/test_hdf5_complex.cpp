// Complex numbers in HDF5 files: two real arrays, which every program reads.
#include "mbs/base/error.hpp"
#include "solvers/hdf5/file.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"

using namespace cardan;
using namespace cardan::solvers;
using cardan::test::Folder;
using Catch::Contains;
using ComplexNumbers = std::vector<std::complex<double>>;

TEST_CASE("hdf5 complex numbers: two arrays hold them, both with units and a long name", "[property]") {
    const Folder folder;
    Hdf5File file = Hdf5File::create(folder / "a.h5");
    file.write("g/z", ComplexNumbers{{1.0, -2.0}, {0.0, 3.5}}, {1, 2}, {"s-1", "eigenvalue", {{"note", "kept"}}});
    CHECK_FALSE(file.has("g/z"));
    CHECK(file.read_doubles("g/z_real") == std::vector<double>{1.0, 0.0});
    CHECK(file.read_doubles("g/z_imag") == std::vector<double>{-2.0, 3.5});
    CHECK(file.read_complex("g/z") == ComplexNumbers{{1.0, -2.0}, {0.0, 3.5}});
    CHECK(file.string_attribute("g/z_real", "long_name") == "eigenvalue, real part");
    CHECK(file.string_attribute("g/z_imag", "long_name") == "eigenvalue, imaginary part");
    for (const char* name : {"g/z_real", "g/z_imag"}) {
        CHECK(file.shape(name) == Shape{1, 2});
        CHECK(file.string_attribute(name, "units") == "s-1");
        CHECK(file.string_attribute(name, "note") == "kept");
    }
}

TEST_CASE("hdf5 complex numbers: compounds of earlier versions and of h5py are read", "[property]") {
    const Hdf5File file = Hdf5File::open(CARDAN_SOURCE_DIR "/tests/data/complex_compound.h5");
    CHECK(file.read_complex("z") == ComplexNumbers{{1.0, -2.0}, {0.0, 3.5}});
}

TEST_CASE("hdf5 complex numbers: what cannot be written leaves neither array, and both must be as long", "[property]") {
    const Folder folder;
    Hdf5File file = Hdf5File::create(folder / "a.h5");
    file.write("z_imag", std::vector<double>{1, 2, 3}, {3}, {"m", "z"});
    CHECK_THROWS_WITH(file.write("z", ComplexNumbers{1.0}, {1}, {"m", "z"}), Contains("z_imag: exists already"));
    CHECK_THROWS_WITH(file.write("y", ComplexNumbers{1.0}, {1}, {"m", ""}), Contains("y: long_name is missing"));
    CHECK_THROWS_WITH(file.write("", ComplexNumbers{1.0}, {1}, {"m", "z"}), Contains("is not a name"));
    CHECK_THROWS_WITH(file.write("y", ComplexNumbers{1.0}, {2}, {"m", "y"}), Contains("1 values do not fill"));
    CHECK(file.children() == std::vector<std::string>{"z_imag"});
    file.write("z_real", std::vector<double>{1, 2}, {2}, {"m", "z"});
    CHECK_THROWS_WITH(file.read_complex("z"), Contains("z: 2 real parts, 3 imaginary parts"));
}
