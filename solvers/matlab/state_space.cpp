#include "solvers/matlab/state_space.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/pending_file.hpp"
#include "mbs/base/version.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <matio.h>
#include <memory>
#include <span>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;

struct FreeVariable {
    void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using Variable = std::unique_ptr<matvar_t, FreeVariable>;

struct CloseFile {
    void operator()(mat_t* file) const { Mat_Close(file); }
};
using File = std::unique_ptr<mat_t, CloseFile>;

Variable checked(matvar_t* made) {
    if (made == nullptr) throw NumericalError("MATLAB file: a variable cannot be made");
    return Variable(made);
}

Variable numbers(std::vector<double> values, std::vector<std::size_t> shape) {
    return checked(Mat_VarCreate(nullptr, MAT_C_DOUBLE, MAT_T_DOUBLE, static_cast<int>(shape.size()), shape.data(),
                                 values.data(), 0));
}

Variable number(double value) {
    return numbers({value}, {1, 1});
}

Variable matrix(const Matrix& A) {
    return numbers({A.data(), A.data() + A.size()},
                   {static_cast<std::size_t>(A.rows()), static_cast<std::size_t>(A.cols())});
}

// UTF-8 to UTF-16; bytes that are no UTF-8 become '?'. In UTF-8 libmatio counts now bytes, now characters.
std::u16string utf16(const std::string& words) {
    std::u16string out;
    for (std::size_t at = 0; at < words.size();) {
        const auto byte = [&](std::size_t i) {
            return static_cast<std::uint32_t>(static_cast<unsigned char>(words[i]));
        };
        const std::uint32_t first = byte(at);
        const std::size_t size = first < 0x80                   ? 1
                                 : first < 0xC2 || first > 0xF4 ? 0
                                 : first < 0xE0                 ? 2
                                 : first < 0xF0                 ? 3
                                                                : 4;
        std::uint32_t code = size < 2 ? first : first & (0x7Fu >> size);
        bool whole = size > 0 && at + size <= words.size();
        for (std::size_t i = 1; whole && i < size; ++i) {
            whole = (byte(at + i) & 0xC0) == 0x80;
            code = code << 6 | (byte(at + i) & 0x3F);
        }
        at += whole ? size : 1;
        if (!whole)
            out += u'?';
        else if (code < 0x10000)
            out += static_cast<char16_t>(code);
        else
            (out += static_cast<char16_t>(0xD7C0 + (code >> 10))) += static_cast<char16_t>(0xDC00 + (code & 0x3FF));
    }
    return out;
}

Variable characters(const std::string& words) {
    std::u16string units = utf16(words);
    std::array<std::size_t, 2> shape{units.empty() ? std::size_t{0} : std::size_t{1}, units.size()};
    return checked(Mat_VarCreate(nullptr, MAT_C_CHAR, MAT_T_UTF16, 2, shape.data(), units.data(), 0));
}

Variable cells(const std::vector<Signal>& signals, std::string Signal::*field) {
    std::array<std::size_t, 2> shape{signals.size(), 1};
    Variable all = checked(Mat_VarCreate(nullptr, MAT_C_CELL, MAT_T_CELL, 2, shape.data(), nullptr, 0));
    for (std::size_t i = 0; i < signals.size(); ++i)
        Mat_VarSetCell(all.get(), static_cast<int>(i), characters(signals[i].*field).release());
    return all;
}

// A structure that is filled field by field.
class Structure {
public:
    explicit Structure(const std::string& name) {
        const std::array<std::size_t, 2> one{1, 1};
        variable_ = checked(Mat_VarCreateStruct2(name.c_str(), 2, one.data(), nullptr));
    }
    void set(const char* field, Variable value) {
        if (Mat_VarAddStructField(variable_.get(), field) != 0)
            throw NumericalError(text("MATLAB file: the field ", field, " cannot be made"));
        Mat_VarSetStructFieldByName(variable_.get(), field, 0, value.release());
    }
    matvar_t* get() const { return variable_.get(); }

private:
    Variable variable_;
};

void set_signals(Structure& s, const std::vector<Signal>& states, const std::vector<Signal>& inputs,
                 const std::vector<Signal>& outputs) {
    s.set("state_names", cells(states, &Signal::name));
    s.set("state_units", cells(states, &Signal::units));
    s.set("input_names", cells(inputs, &Signal::name));
    s.set("input_units", cells(inputs, &Signal::units));
    s.set("output_names", cells(outputs, &Signal::name));
    s.set("output_units", cells(outputs, &Signal::units));
    s.set("output_aliases", cells(outputs, &Signal::alias));
}

struct NamedMatrix {
    const char* name;
    const char* in_series;
    Matrix StateMatrices::*matrix;
};
constexpr NamedMatrix matrices[] = {{"A", "fourier_A", &StateMatrices::A},
                                    {"B", "fourier_B", &StateMatrices::B},
                                    {"C", "fourier_C", &StateMatrices::C},
                                    {"D", "fourier_D", &StateMatrices::D}};

// Side by side along the third axis.
template <class Items>
Variable stack(const Items& items, Matrix StateMatrices::*m) {
    const Matrix& first = items.front().*m;
    std::vector<double> values;
    for (const auto& item : items) values.insert(values.end(), (item.*m).data(), (item.*m).data() + (item.*m).size());
    return numbers(std::move(values),
                   {static_cast<std::size_t>(first.rows()), static_cast<std::size_t>(first.cols()), items.size()});
}

Variable columns(const LinearModel& model, Vector LinearSample::*field) {
    Matrix all((model.samples[0].*field).size(), std::ssize(model.samples));
    for (Index i = 0; i < all.cols(); ++i) all.col(i) = entry(model.samples, i).*field;
    return matrix(all);
}

Structure periodic(const LinearModel& model) {
    Structure s("model");
    s.set("machine", characters(model.machine));
    s.set("description", characters(model.description));
    s.set("cardan_version", characters(std::string(version())));
    s.set("rotor_speed", number(model.rotor_speed));
    s.set("blades", number(model.blades));
    Matrix azimuth(1, std::ssize(model.samples));
    for (Index i = 0; i < azimuth.cols(); ++i) azimuth(0, i) = entry(model.samples, i).azimuth;
    s.set("azimuth", matrix(azimuth));
    set_signals(s, model.states, model.inputs, model.outputs);
    const std::vector<StateMatrices> series = fourier_coefficients(model);
    for (const NamedMatrix& m : matrices) {
        s.set(m.name, stack(model.samples, m.matrix));
        s.set(m.in_series, stack(series, m.matrix));
    }
    s.set("x_operating", columns(model, &LinearSample::x));
    s.set("xdot_operating", columns(model, &LinearSample::xdot));
    s.set("u_operating", columns(model, &LinearSample::u));
    s.set("y_operating", columns(model, &LinearSample::y));
    s.set("output_error", matrix(model.output_error));
    return s;
}

Structure constant_model(const NamedModel& named) {
    const ConstantModel& model = named.model;
    Structure s(named.name);
    s.set("machine", characters(model.machine));
    s.set("description", characters(model.description));
    s.set("rotor_speed", number(model.rotor_speed));
    set_signals(s, model.states, model.inputs, model.outputs);
    for (const NamedMatrix& m : matrices) s.set(m.name, matrix(model.*m.matrix));
    return s;
}

// libmatio does not look at every write: what is there is read again, checksums of the compression included.
bool readable(const std::string& path, std::size_t variables) {
    const File file(Mat_Open(path.c_str(), MAT_ACC_RDONLY));
    if (!file) return false;
    std::size_t count = 0;
    while (const Variable variable{Mat_VarReadNext(file.get())}) ++count;
    return count == variables;
}

}  // namespace

void write_mat(const LinearModel& model, const std::vector<NamedModel>& constant, const std::filesystem::path& path) {
    if (model.samples.empty()) throw InputError("MATLAB file", "number of azimuths", 0, ">= 1");
    check_names(constant, "MATLAB file", {"model"});
    const PendingFile pending(path);
    try {
        std::vector<Structure> all;
        all.push_back(periodic(model));
        for (const NamedModel& named : constant) all.push_back(constant_model(named));
        const std::string head = text("MATLAB 5.0 MAT-file, Cardan ", version());
        File file(Mat_CreateVer(pending.partial().c_str(), head.c_str(), MAT_FT_MAT5));
        bool good = file != nullptr;
        for (const Structure& s : all) good = good && Mat_VarWrite(file.get(), s.get(), MAT_COMPRESSION_ZLIB) == 0;
        if (file) good = Mat_Close(file.release()) == 0 && good;
        if (!good || !readable(pending.partial(), all.size()))
            throw FileError(pending.path(), "cannot be written completely (is the disk full?)");
        pending.commit();
    } catch (...) {
        pending.discard();
        throw;
    }
}

}  // namespace cardan::solvers
