#include "elements/controllers/bladed_controller.hpp"

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

    static std::string reason() {
        const char* const words = dlerror();
        return words ? words : "no reason is given";
    }

private:
    void* handle_;
    Discon* function_ = nullptr;
    std::vector<float> swap_;
    std::vector<char> input_, output_, message_;
};

std::string BladedController::why_not_loaded(const std::filesystem::path& library) {
    void* const handle = dlopen(std::filesystem::absolute(library).c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr) return Library::reason();
    dlclose(handle);
    return {};
}

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
        {7, own_.max_pitch},
        {8, own_.min_pitch_rate},
        {9, own_.max_pitch_rate},
        {10, 0},  // pitch angles, not rates
        {11, library_->at(own_.individual_pitch ? 42 : 45)},
        {14, now.generator_torque * now.generator_speed},
        {15, now.power},
        {17, 0},
        {18, own_.rated_speed},
        {19, own_.rated_speed},
        {20, now.generator_speed},
        {21, now.rotor_speed},
        {22, own_.max_torque},
        {23, now.generator_torque},
        {24, now.yaw_error},
        {27, now.wind_speed},
        {28, own_.individual_pitch ? 1.0 : 0.0},
        {29, 0},  // yaw rates, not torques
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

void BladedController::remark(const std::string& words, std::vector<std::string>& remarks) {
    if (told_.insert(words).second) remarks.push_back(words);
}

void BladedController::call(double status, const Measured& now, std::vector<std::string>& remarks) {
    write(now);
    library_->set(1, status);
    const int fail = library_->call();
    const std::string words = library_->message();
    if (fail > 0) remark(words.empty() ? text("a warning without words (", fail, ")") : words, remarks);
    if (fail >= 0) return;
    throw NumericalError(text("controller ", path_.string(), ": at ", now.time, " s it reports a failure (", fail, ")",
                              words.empty() ? "" : ": ", words));
}

// Contactor and brake stay in their records: what was demanded is what is told at the next call.
BladedController::Demand BladedController::read() const {
    const Library& swap = *library_;
    const auto number = [&](std::size_t record, const std::string& what) {
        const double value = swap.at(record);
        if (std::isfinite(value)) return value;
        throw NumericalError(
            text("controller ", path_.string(), ": at ", last_.time, " s it demands a ", what, " of ", value));
    };
    const auto whole = [&](std::size_t record, const char* what, const std::vector<int>& allowed, const char* words) {
        const double value = number(record, what);
        for (const int one : allowed)
            if (std::abs(value - one) < 0.5) return one;
        throw NumericalError(text("controller ", path_.string(), ": at ", last_.time, " s it demands a ", what, " of ",
                                  value, " (record ", record, "); allowed: ", words));
    };
    Demand out;
    for (std::size_t k = 0; k < 3; ++k) {
        const bool asked = static_cast<int>(k) < own_.blades;
        out.pitch.at(k) = asked ? number(own_.individual_pitch ? 42 + k : 45, "pitch") : 0;
    }
    out.generator_connected = whole(35, "contactor", {0, 1}, "1, the generator, or 0, none") == 1;
    out.torque = number(47, "generator torque");
    if (!out.generator_connected) out.torque = 0;
    const int brake = whole(36, "shaft brake", {0, 1, 16}, "0, off, 1, on, or 16, the torque of record 107");
    out.brake.status = brake == 0 ? Brake::Status::off : brake == 1 ? Brake::Status::on : Brake::Status::torque;
    if (out.brake.status == Brake::Status::torque) out.brake.torque = number(107, "brake torque");
    out.yaw_rate = number(48, "yaw rate");
    out.message = swap.message();
    return out;
}

BladedController::Demand BladedController::step(const Measured& now) {
    if (finished_) throw InputError(text("controller ", path_.string()), "call", "after the last one", "none");
    last_ = now;
    if (!started_) {
        // The demands start from what is there: a controller that sets nothing at first keeps it.
        for (std::size_t k = 0; k < 3; ++k) library_->set(42 + k, now.pitch.at(k));
        library_->set(45, now.pitch[0]);
        library_->set(47, now.generator_torque);
        library_->set(35, 1);
    }
    std::vector<std::string> remarks;
    call(started_ ? 1 : 0, now, remarks);
    started_ = true;
    struct Unheard {
        std::size_t record;
        const char* what;
    };
    static constexpr std::array unheard{Unheard{55, "pitch of the machine's own (record 55)"},
                                        Unheard{56, "torque of the machine's own (record 56)"},
                                        Unheard{102, "stiffness, damping or torque of the yaw drive (record 102)"}};
    for (const auto& [record, what] : unheard)
        if (library_->at(record) != 0) remark(text("it asks for a ", what, ", which there is not"), remarks);
    Demand out = read();
    out.remarks = std::move(remarks);
    return out;
}

void BladedController::finish() {
    if (!started_ || finished_) return;
    finished_ = true;
    std::vector<std::string> last_words;
    call(-1, last_, last_words);
}

}  // namespace cardan
