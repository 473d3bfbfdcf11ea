// Wind files of Bladed itself with the text that says how to scale them: InflowWind's WindType 7.
#include "mbs/base/text_file.hpp"
#include "turbines/readers/bladed_box.hpp"
#include "turbines/readers/detail/bladed_header.hpp"
#include "turbines/readers/detail/openfast_words.hpp"

#include <algorithm>
#include <iterator>
#include <map>

namespace cardan::turbines {

namespace {

// Words and values of a text, either one before the other.
class NativeWords {
public:
    NativeWords(std::string all, const std::string& file) : file_(file) {
        require_text(all, file, TextRules::any_bytes);
        std::istringstream lines = text_reader(std::move(all));
        for (std::string line; std::getline(lines, line);) add(line);
    }

    double number(const char* word, double min, double max) {
        const Entry& entry = known(word);
        const auto value = fortran_number(entry.value);
        if (!value) fail(entry, text(word, ": '", entry.value, "' is not a number"));
        if (*value < min || *value > max) fail(entry, text(word, " = ", *value, "; allowed: ", min, " ... ", max));
        return *value;
    }
    double number_or_zero(const char* word, double min, double max) {
        return find(word) == entries_.end() ? 0 : number(word, min, max);
    }
    std::filesystem::path path(const char* word) {
        const Entry& entry = known(word);
        std::filesystem::path out = file_beside(file_, entry.value);
        if (out.empty()) fail(entry, text(word, ": the name of the file is empty"));
        return out;
    }
    [[noreturn]] void fail(const char* word, const std::string& what) { fail(known(word), what); }
    std::vector<FileNote> notes() const {
        std::vector<FileNote> out;
        for (const auto& [word, entry] : entries_)
            if (!entry.used)
                out.push_back(
                    {file_, entry.line, entry.word, entry.value, "of no meaning for the wind", FileNote::Kind::unused});
        return out;
    }

private:
    struct Entry {
        std::string word, value;
        int line;
        bool used = false;
    };
    using Entries = std::map<std::string, Entry>;

    // Which of the two is the word: that which is known, else the first one.
    static bool is_known(std::string_view word) {
        constexpr std::string_view all[] = {"ubar",  "refht",  "ti",        "ti_v",      "ti_w",      "wdir",   "flinc",
                                            "windf", "wshear", "vlinshear", "hlinshear", "reflength", "xoffset"};
        return std::find(std::begin(all), std::end(all), lower_case(word)) != std::end(all);
    }

    void add(std::string_view line) {
        ++line_;
        line = line.substr(0, line.find_first_of("!#%"));
        std::vector<std::string> words;
        while (words.size() < 2) {
            line.remove_prefix(std::min(line.find_first_not_of(" \t\r,"), line.size()));
            if (line.empty()) break;
            const bool quoted = line.front() == '"' || line.front() == '\'';
            const std::size_t end = quoted ? line.find(line.front(), 1) : line.find_first_of(" \t\r,");
            words.emplace_back(line.substr(quoted ? 1 : 0, quoted ? end - 1 : end));  // npos - 1 is far enough
            line.remove_prefix(end >= line.size() ? line.size() : end + 1);
        }
        if (words.size() < 2) return;
        if (!is_known(words[0]) && is_known(words[1])) std::swap(words[0], words[1]);
        const auto [at, added] = entries_.try_emplace(lower_case(words[0]), Entry{words[0], words[1], line_});
        if (!added && is_known(words[0]))
            throw ParseError(file_, line_, 0, text(words[0], " occurs twice, first in line ", at->second.line));
    }

    Entries::iterator find(const char* word) { return entries_.find(lower_case(std::string_view(word))); }
    const Entry& known(const char* word) {
        const auto at = find(word);
        if (at == entries_.end()) throw ParseError(file_, line_, 0, text("ends without the entry ", word));
        at->second.used = true;
        return at->second;
    }
    [[noreturn]] void fail(const Entry& entry, const std::string& what) const {
        throw ParseError(file_, entry.line, 0, what);
    }

    std::string file_;
    Entries entries_;
    int line_ = 0;
};

constexpr double native_far = 1e5;

SteadyWind native_mean(NativeWords& in) {
    constexpr auto upward = "VLINSHEAR", across = "HLINSHEAR", over = "REFLENGTH";
    SteadyWind out;
    out.speed = in.number("UBAR", 1e-3, 1e3);
    out.reference_height = in.number("REFHT", 1e-3, native_far);
    out.exponent = in.number("WSHEAR", -10, 10);
    out.shear = Shear::power;
    out.gradient = in.number_or_zero(upward, -1e3, 1e3);
    out.lateral = in.number_or_zero(across, -1e3, 1e3);
    if (out.gradient == 0 && out.lateral == 0) {
        in.number_or_zero(over, -native_far, native_far);
    } else {
        const double length = in.number(over, 1e-3, native_far);
        out.gradient /= length;
        out.lateral /= length;
        try {
            out.check();
        } catch (const InputError& error) {
            in.fail(over, error.what());
        }
    }
    return out;
}

// Each component to its intensity at the middle point.
void scale_to(WindBoxData& box, NativeWords& in, double speed) {
    constexpr const char* words[] = {"TI", "TI_V", "TI_W"};
    const Vec3 is = WindBox(box).statistics((box.grid.rows - 1) / 2, (box.grid.columns - 1) / 2).deviation;
    for (std::size_t c = 0; c < 3; ++c) {
        const double intensity = in.number(words[c], 0, 100);
        const double deviation = is(static_cast<Eigen::Index>(c));
        if (intensity > 0 && box.components[c].scale != 0 && !(deviation > 0))
            in.fail(words[c], text(words[c], " = ", intensity,
                                   "; allowed: 0, for a component of the file that does "
                                   "not change at the middle point"));
        box.components[c].scale *= deviation > 0 ? intensity * speed / deviation : 0;
    }
}

}  // namespace

WindBoxFile read_native_bladed_box(const std::filesystem::path& path) {
    const std::string all = text_file(path);
    NativeWords in(all, path.string());
    WindBoxFile out;
    out.mean = native_mean(in);
    out.direction = -in.number("WDIR", -2 * pi, 2 * pi);
    out.upflow = in.number("FLINC", -pi / 2, pi / 2);

    BoxSources sources;
    const MappedFile& file = sources.map(in.path("WINDF"));
    const BladedHeader header = read_bladed_header(file);
    sources.sum();
    sources.name(path);
    sources.sum(std::as_bytes(std::span(all)));

    WindBoxData box = bladed_numbers(file, header, out.mean.speed, false);
    box.grid.lowest = out.mean.reference_height - box.grid.height() / 2;
    box.components[1].scale *= -1;
    scale_to(box, in, out.mean.speed);
    box.periodic = true;
    box.start = in.number_or_zero("XOffset", -1e9, 1e9);
    box.below = BelowBox::to_ground;
    box.origin = sources.origin("Bladed .wnd");
    sources.keep_in(box);
    out.box = std::make_shared<const WindBox>(std::move(box));
    out.notes = in.notes();
    return out;
}

}  // namespace cardan::turbines
