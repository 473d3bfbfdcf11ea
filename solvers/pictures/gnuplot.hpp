/// @file
/// Pictures by gnuplot, a child process: one script, with its data inside, makes one picture.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace cardan::solvers {

/// Size in pixels, 96 per inch in a PDF.
struct PictureSize {
    int width = 1000;
    int height = 700;
};

struct Colour {
    std::string_view name;
    std::string_view hex;  ///< "#rrggbb"
};

/// Colours that remain distinguishable with any kind of colour blindness, on white, in order of preference. [Okabe and
/// Ito 2008, without their yellow, which is too faint for a line on white]
inline constexpr std::array<Colour, 7> palette{{{"blue", "#0072b2"},
                                                {"vermilion", "#d55e00"},
                                                {"green", "#009e73"},
                                                {"purple", "#cc79a7"},
                                                {"orange", "#e69f00"},
                                                {"sky blue", "#56b4e9"},
                                                {"black", "#000000"}}};

/// The colour of the index-th family; colours repeat after the last one, so vary dashes or symbols as well.
[[nodiscard]] constexpr const Colour& colour(std::size_t index) {
    return palette[index % palette.size()];
}

/// Any text as a gnuplot string, quotes included, that shows exactly this text: no subscripts from underscores, no
/// commands from quotes, backquotes or line ends (control characters become blanks).
[[nodiscard]] std::string gnuplot_text(std::string_view shown);

/// The lines "$name << EOD ... EOD" that put columns of equal length into a script; numbers with full double precision,
/// non-finite values as NaN, which leaves a gap in a line. Throws InputError for an invalid name or unequal lengths.
[[nodiscard]] std::string gnuplot_data(std::string_view name, std::span<const std::span<const double>> columns);

class Conversation;

/// Runs gnuplot without a shell and without the user's settings (gnuplot -d). The process starts with the first script
/// and ends with the object: pictures of one run are drawn by one, whose start takes longer than most pictures. Every
/// script finds the same defaults and nothing of the scripts before. One per thread.
class Gnuplot {
public:
    /// @param program  a name looked up in PATH, or a path
    explicit Gnuplot(std::string program = "gnuplot");
    Gnuplot(const Gnuplot&) = delete;
    Gnuplot& operator=(const Gnuplot&) = delete;
    Gnuplot(Gnuplot&&) noexcept;
    Gnuplot& operator=(Gnuplot&&) noexcept;
    ~Gnuplot();

    /// Process that draws all pictures of this library, so that those of one run have one process. Ends with the
    /// thread.
    static const Gnuplot& of_this_thread();

    /// Runs a script from beginning to end and returns what gnuplot printed: warnings and the output of `print`.
    /// Throws Error with gnuplot's message if a command fails, FileError if gnuplot is not installed. The script is
    /// trusted: gnuplot has commands that run programs. Foreign texts go through gnuplot_text.
    std::string run(std::string_view script) const;

    /// Draws body into a file whose extension selects the format: .svg, .png or .pdf. Sets up before the body: the
    /// terminal (white background, DejaVu Sans, enhanced text), UTF-8, line types 1 to 7 in the colours of the palette,
    /// a light grid. The file appears when it is complete; an older one stays until then. Throws FileError for another
    /// ending, a path that cannot be written (before gnuplot runs) and a full disk.
    /// @return what gnuplot printed: warnings
    std::string write_picture(const std::filesystem::path& path, std::string_view body, PictureSize size = {}) const;

private:
    std::string program_;
    mutable std::unique_ptr<Conversation> process_;  // none before the first script, and after one that failed
};

}  // namespace cardan::solvers
