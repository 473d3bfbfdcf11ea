#include "solvers/campbell_data/csv.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/pending_file.hpp"
#include "mbs/base/units.hpp"
#include "mbs/base/version.hpp"

namespace cardan::solvers {

std::string csv_comment(std::string words) {
    for (char& c : words)
        if (c == '\n' || c == '\r') c = ' ';
    return "# " + words + "\n";
}

std::string csv_field(std::string_view words) {
    if (words.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(words);
    std::string quoted = "\"";
    for (char c : words) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + "\"";
}

void write_csv(const Campbell& diagram, const std::filesystem::path& path) {
    std::ostringstream out = text_stream();
    out.precision(10);
    out << csv_comment(
        text("Campbell diagram: ", diagram.machine, "; ", method_in_words(diagram), "; cardan ", version()));
    for (const std::string& line : {diagram.remark, diagram.accuracy})
        if (!line.empty()) out << csv_comment(line);
    if (!diagram.warning.empty()) out << csv_comment("warning: " + diagram.warning);
    if (!diagram.complete) out << csv_comment("the sweep was interrupted");
    out << "rotor_speed[rpm],mode[-],natural_frequency[Hz],damped_frequency[Hz],damping_ratio[-],mac[-],doubtful[-],"
           "mostly[-],kind[-],growth_rate[1/s],stability_margin[1/s],"
           "doubt[-]"
        << (diagram.parameter.empty() ? "" : ",") << csv_field(diagram.parameter) << "\n";
    for (std::size_t i = 0; i < diagram.points.size(); ++i)
        for (const Branch& branch : diagram.branches) {
            const CampbellMode* mode = diagram.mode(branch, i);
            if (!mode) continue;
            out << diagram.points[i].rotor_speed * units::to_rpm << ',' << csv_field(branch.name) << ','
                << diagram.natural_hz(branch, i) << ',' << diagram.damped_hz(branch, i) << ','
                << diagram.damping_ratio(branch, i) << ',' << branch.mac[i] << ',' << (branch.doubtful[i] ? 1 : 0)
                << ',' << csv_field(branch.mostly[i]) << ',' << mode->kind_name() << ',' << mode->mode.eigenvalue.real()
                << ',' << diagram.points[i].stability_margin << ',' << csv_field(branch.doubt[i]);
            if (!diagram.parameters.empty()) out << ',' << diagram.parameters[i];
            out << '\n';
        }
    write_file(path, out.str());
}

}  // namespace cardan::solvers
