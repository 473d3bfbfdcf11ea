#include "elements/control/bladed_controller.hpp"

#include "mbs/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <dlfcn.h>
#include <utility>
#include <vector>

namespace cardan {

namespace {

using Discon = void(float* swap, int* fail, char* input, char* output, char* message);

constexpr std::size_t records = 3300;  // as Bladed has them; those from 1000 on are for the user's own
constexpr std::size_t message_length = 1024;

}  // namespace

// The loaded library, and the numbers and texts that it works on.
class BladedController::Library {
public:
    Library(const std::filesystem::path& path, const Options& options)
        // A name without a folder would be looked for where the system keeps its libraries.
        : handle_(dlopen(std::filesystem::absolute(path).c_str(), RTLD_NOW | RTLD_LOCAL)),
          swap_(records + 1),
          input_(options.input.begin(), options.input.end()),
          output_(options.output.begin(), options.output.end()),
          message_(message_length) {
        if (!handle_) throw FileError(path.string(), text("no controller: ", reason()));
        void* const symbol = dlsym(handle_, options.function.c_str());
        if (!symbol) {
            const std::string why = reason();
            dlclose(handle_);
            throw FileError(path.string(), text("no function '", options.function, "' in it: ", why));
        }
        function_ = reinterpret_cast<Discon*>(symbol);
        for (std::vector<char>* words : {&input_, &output_}) words->push_back('\0');
    }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
    ~Library() { dlclose(handle_); }

    /// Record i, counted from 1.
    void set(std::size_t i, double value) { swap_[i - 1] = static_cast<float>(value); }
    double at(std::size_t i) const { return static_cast<double>(swap_[i - 1]); }

    int call() {
        int fail = 0;
        std::ranges::fill(message_, '\0');
        set(49, static_cast<double>(message_.size()));
        set(50, static_cast<double>(input_.size()));
        set(51, static_cast<double>(output_.size()));
        function_(swap_.data(), &fail, input_.data(), output_.data(), message_.data());
        return fail;
    }
    std::string message() const {
        std::string words(message_.data(), std::ranges::find(message_, '\0') - message_.begin());
        words.erase(words.find_last_not_of(" \t\r\n") + 1);
        return words;
    }

private:
    static std::string reason() {
        const char* const words = dlerror();
        return words ? words : "no reason is given";
    }

    void* handle_;
    Discon* function_ = nullptr;
    std::vector<float> swap_;
    std::vector<char> input_, output_, message_;
};

BladedController::BladedController(const std::filesystem::path& library, Options options)
    : path_(library), own_(std::move(options)) {
    const std::string where = text("controller ", library.string());
    require_positive(where, "period [s]", own_.period);
    if (own_.blades < 1 || own_.blades > 3) throw InputError(where, "number of blades", own_.blades, "1 ... 3");
    library_ = std::make_unique<Library>(library, own_);
}

BladedController::~BladedController() {
    try {
        finish();
    } catch (...) {  // NOLINT(bugprone-empty-catch): what is over cannot fail any more
    }
}

void BladedController::write(const Measured& now) {
    struct Record {
        std::size_t number;
        double value;
    };
    const auto all = std::to_array<Record>({
        {2, now.time},
        {3, own_.period},
        {4, now.pitch[0]},
        {33, now.pitch[1]},
        {34, now.pitch[2]},
        {5, own_.fine_pitch},
        {6, own_.fine_pitch},
        {7, own_.largest_pitch},
        {8, own_.least_pitch_rate},
        {9, own_.largest_pitch_rate},
        {15, now.power},
        {17, 0},
        {18, own_.rated_speed},
        {19, own_.rated_speed},
        {20, now.generator_speed},
        {21, now.rotor_speed},
        {22, own_.largest_torque},
        {23, now.generator_torque},
        {24, now.yaw_error},
        {27, now.wind_speed},
        {37, now.yaw},
        {53, now.tower_acceleration},
        {60, now.azimuth},
        {61, static_cast<double>(own_.blades)},
        {63, 1000},  // where the controller's own outputs may begin, how many, and how long their names may be
        {64, 0},
        {65, 0},
        {83, now.nacelle_nodding},
        {129, static_cast<double>(records)},
    });
    for (const Record& record : all) library_->set(record.number, record.value);
    for (std::size_t k = 0; k < 3; ++k) {
        library_->set(30 + k, now.out_of_plane.at(k));
        library_->set(69 + k, now.in_plane.at(k));
    }
}

void BladedController::call(double status, const Measured& now) {
    write(now);
    library_->set(1, status);
    const int fail = library_->call();
    if (fail >= 0) return;
    const std::string words = library_->message();
    throw NumericalError(text("controller ", path_.string(), ": at ", now.time, " s it reports a failure (", fail, ")",
                              words.empty() ? "" : ": ", words));
}

BladedController::Demand BladedController::step(const Measured& now) {
    if (finished_) throw InputError(text("controller ", path_.string()), "call", "after the last one", "none");
    last_ = now;
    if (!started_) {
        // The demands start from what is there: a controller that sets nothing at first keeps it.
        for (std::size_t k = 0; k < 3; ++k) library_->set(42 + k, now.pitch.at(k));
        library_->set(45, now.pitch[0]);
        library_->set(47, now.generator_torque);
    }
    call(started_ ? 1 : 0, now);
    started_ = true;
    Demand out;
    const Library& swap = *library_;
    const bool individual = swap.at(28) != 0;
    for (std::size_t k = 0; k < 3; ++k) out.pitch.at(k) = swap.at(individual ? 42 + k : 45);
    out.torque = swap.at(47);
    out.yaw_rate = swap.at(48);
    out.message = swap.message();
    const auto require = [&](double value, const char* what) {
        if (std::isfinite(value)) return;
        throw NumericalError(
            text("controller ", path_.string(), ": at ", now.time, " s it demands a ", what, " of ", value));
    };
    for (const double pitch : out.pitch) require(pitch, "pitch");
    require(out.torque, "generator torque");
    return out;
}

void BladedController::finish() {
    if (!started_ || finished_) return;
    finished_ = true;
    call(-1, last_);
}

}  // namespace cardan
