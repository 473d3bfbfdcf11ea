#include "mbs/urdf/detail/reading.hpp"

#include <console_bridge/console.h>
#include <mutex>
#include <urdf_parser/urdf_parser.h>

namespace cardan::urdf_impl {

namespace {

class Collector : public console_bridge::OutputHandler {
public:
    // No exception may escape: the caller is a C-style variadic function that does not expect one.
    void log(const std::string& message, console_bridge::LogLevel level, const char* /*file*/, int /*line*/) override {
        try {
            (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR ? errors : warnings).push_back(message);
        } catch (...) {
            lost = true;
        }
    }
    std::vector<std::string> errors, warnings;
    bool lost = false;
};

// While it exists, console_bridge reports only to us.
class Listening {
public:
    explicit Listening(Collector& collector)
        : before_(console_bridge::getOutputHandler()), level_(console_bridge::getLogLevel()) {
        console_bridge::useOutputHandler(&collector);
        console_bridge::setLogLevel(console_bridge::CONSOLE_BRIDGE_LOG_WARN);
    }
    Listening(const Listening&) = delete;
    Listening& operator=(const Listening&) = delete;
    ~Listening() {
        console_bridge::setLogLevel(level_);
        // Twice: console_bridge also remembers the handler before the present one, and ours is about to go.
        console_bridge::useOutputHandler(before_);
        console_bridge::useOutputHandler(before_);
    }

private:
    console_bridge::OutputHandler* before_;
    console_bridge::LogLevel level_;
};

std::string joined(const std::vector<std::string>& messages) {
    std::string all;
    for (const std::string& message : messages) all += (all.empty() ? "" : "; ") + message;
    return all;
}

std::shared_ptr<urdf::ModelInterface> parse(const Outline& outline, Collector& collector) {
    static std::mutex one_at_a_time;  // the handler is global
    const std::lock_guard lock(one_at_a_time);
    const Listening listening(collector);
    try {
        return urdf::parseURDF(outline.tidy);
    } catch (const std::exception& error) {
        throw InputError(text(outline.source, ": urdfdom: ", error.what()));
    }
}

}  // namespace

std::shared_ptr<urdf::ModelInterface> urdfdom_model(const Outline& outline, std::vector<std::string>& warnings) {
    Collector collector;
    std::shared_ptr<urdf::ModelInterface> model = parse(outline, collector);
    if (!collector.errors.empty()) throw InputError(text(outline.source, ": urdfdom: ", joined(collector.errors)));
    if (collector.lost) throw InputError(text(outline.source, ": urdfdom: a message was lost for want of memory"));
    if (!model) throw InputError(text(outline.source, ": urdfdom refuses this document without giving a reason"));
    for (const std::string& warning : collector.warnings)
        warnings.push_back(text(outline.source, ": urdfdom: ", warning));
    return model;
}

}  // namespace cardan::urdf_impl
