#include "solvers/pictures/gnuplot.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/pending_file.hpp"
#include "solvers/pictures/detail/conversation.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <sys/mman.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <vector>

namespace cardan::solvers {
namespace {

namespace fs = std::filesystem;

/// A file under the folder for temporary ones that goes away with the object.
class ScratchFile {
public:
    ScratchFile() {
        std::error_code code;
        const fs::path folder = fs::temp_directory_path(code);
        if (code) throw FileError("the folder for temporary files (TMPDIR)", code.message());
        path_ = (folder / "cardan_plot_XXXXXX").string();
        fd_ = ::mkostemp(path_.data(), O_CLOEXEC);
        if (fd_ < 0) throw FileError(path_, text("cannot be created: ", system_reason(errno)));
    }
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;
    ScratchFile(ScratchFile&&) = delete;
    ScratchFile& operator=(ScratchFile&&) = delete;
    ~ScratchFile() {
        ::close(fd_);
        ::unlink(path_.c_str());
    }

    [[nodiscard]] const std::string& path() const { return path_; }

    void write(std::string_view all) const {
        while (!all.empty()) {
            const ssize_t n = ::write(fd_, all.data(), all.size());
            if (n < 0 && errno == EINTR) continue;
            if (n < 0) throw FileError(path_, text("cannot be written: ", system_reason(errno)));
            all.remove_prefix(static_cast<std::size_t>(n));
        }
    }

private:
    std::string path_;
    int fd_ = -1;
};

/// A file in memory, which another process finds under its path, and which no full disk cuts short.
class MemoryFile {
public:
    MemoryFile() : fd_(::memfd_create("cardan picture", MFD_CLOEXEC)) {
        if (fd_ < 0) throw FileError("a picture in memory", text("cannot be created: ", system_reason(errno)));
    }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    MemoryFile(MemoryFile&&) = delete;
    MemoryFile& operator=(MemoryFile&&) = delete;
    ~MemoryFile() { ::close(fd_); }

    [[nodiscard]] std::string path() const { return text("/proc/", ::getpid(), "/fd/", fd_); }
    [[nodiscard]] std::string contents() const {
        std::ifstream in(path(), std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }

private:
    int fd_;
};

std::string trimmed(std::string all) {
    const char* const blanks = " \t\r\n\f";
    all.erase(0, all.find_first_not_of(blanks));
    all.erase(all.find_last_not_of(blanks) + 1);
    return all;
}

struct Kind {
    std::string_view ending;
    std::string_view terminal;  ///< without size and font
    std::string_view beginning;
    std::string_view end;  ///< somewhere in the last bytes of a complete file
};

constexpr std::array<Kind, 3> kinds{{
    {".svg", "svg enhanced rounded background '#ffffff'", "<?xml", "</svg>"},
    {".png", "pngcairo enhanced rounded background '#ffffff'", "\x89PNG\r\n\x1a\n", "IEND"},
    {".pdf", "pdfcairo enhanced color rounded background '#ffffff'", "%PDF-", "%%EOF"},
}};

const Kind& kind_of(const fs::path& path) {
    const std::string ending = lower_case(path.extension().string());
    for (const Kind& kind : kinds) {
        if (kind.ending == ending) return kind;
    }
    throw FileError(path.string(), "a picture ends in .svg, .png or .pdf");
}

// The terminal for SVG begins with the last colour of the picture before. After this one it is always the same.
constexpr std::string_view after_the_same = "set output '/dev/null'\nplot [0:1] [0:1] 0 notitle\nset output\nreset\n";

std::string terminal(const Kind& kind, PictureSize size) {
    if (kind.ending != ".pdf")
        return text(kind.terminal, " size ", size.width, ",", size.height, " font 'DejaVu Sans,13'");
    constexpr double per_inch = 96.0;
    return text(kind.terminal, " size ", size.width / per_inch, "in,", size.height / per_inch,
                "in font 'DejaVu Sans,10'");
}

std::string line_types() {
    std::string lines;
    for (std::size_t k = 0; k < palette.size(); ++k) {
        lines += text("set linetype ", k + 1, " linecolor rgb '", palette[k].hex, "' linewidth 1.8\n");
    }
    return lines + text("set linetype cycle ", palette.size(), "\n");
}

/// gnuplot does not notice that it cannot write; a picture that is cut off does not end as it should.
bool is_whole(const std::string& all, const Kind& kind) {
    constexpr std::size_t tail = 64;
    return all.starts_with(kind.beginning) &&
           all.find(kind.end, all.size() - std::min(tail, all.size())) != std::string::npos;
}

}  // namespace

std::string gnuplot_text(std::string_view shown) {
    std::string quoted = "'";
    for (const char c : shown) {
        if (std::string_view("_^{}@&~\\").find(c) != std::string_view::npos) quoted += '\\';
        if (c == '\'') quoted += '\'';
        quoted += is_control(c) ? ' ' : c;
    }
    return quoted + "'";
}

std::string gnuplot_data(std::string_view name, std::span<const std::span<const double>> columns) {
    const auto allowed = [](char c) { return is_letter(c) || is_digit(c) || c == '_'; };
    if (name.empty() || is_digit(name.front()) || !std::all_of(name.begin(), name.end(), allowed)) {
        throw InputError("gnuplot data", "name", name, "letters, digits and underscores, no digit in front");
    }
    const std::size_t rows = columns.empty() ? 0 : columns.front().size();
    std::string block = text("$", name, " << EOD\n");
    for (const auto& column : columns) {
        if (column.size() != rows) throw InputError(text("gnuplot data ", name), "length", column.size(), text(rows));
    }
    for (std::size_t row = 0; row < rows; ++row) {
        for (const auto& column : columns) {
            block += std::isfinite(column[row]) ? digits(column[row]) : "NaN";
            block += ' ';
        }
        block.back() = '\n';
    }
    return block + "EOD\n";
}

Gnuplot::Gnuplot(std::string program) : program_(std::move(program)) {}
Gnuplot::Gnuplot(Gnuplot&&) noexcept = default;
Gnuplot& Gnuplot::operator=(Gnuplot&&) noexcept = default;
Gnuplot::~Gnuplot() = default;

const Gnuplot& Gnuplot::of_this_thread() {
    thread_local const Gnuplot gnuplot;
    return gnuplot;
}

// A script is loaded from a file, which an error ends, so that its end can be told. After one the process may be within
// a multiplot: the next script gets another.
std::string Gnuplot::run(std::string_view script) const {
    static const std::string end = "cardan: end of script";
    const ScratchFile commands;
    commands.write(script);
    commands.write("\n");
    if (!process_) process_ = std::make_unique<Conversation>(std::vector<std::string>{program_, "-d"});
    process_->say(text("reset session\nreset errors\nload '", commands.path(), "'\nset print\nprint \"\\n", end,
                       "\", GPVAL_ERRNO\n"));
    std::string said, line;
    const bool alive = process_->listen(end, said, line);
    said = trimmed(std::move(said));
    for (std::size_t at = said.find(commands.path()); at != std::string::npos; at = said.find(commands.path())) {
        said.replace(at, commands.path().size(), "script");
    }
    if (alive && line == end + " 0") return said;
    const int status = alive ? 0 : process_->status();
    process_.reset();
    if (WIFSIGNALED(status)) throw Error(text(program_, ": ended by signal ", WTERMSIG(status), "\n", said));
    throw Error(text(program_, ": failed:\n", said));
}

std::string Gnuplot::write_picture(const fs::path& path, std::string_view body, PictureSize size) const {
    const Kind& kind = kind_of(path);
    if (size.width < 50 || size.height < 50 || size.width > 20000 || size.height > 20000) {
        throw InputError(path.string(), "size", text(size.width, " x ", size.height), "50 to 20000 pixels each way");
    }
    const PendingFile file(path);
    const MemoryFile picture;
    const std::string script = text(
        "set encoding utf8\nset terminal ", terminal(kind, size), "\n", kind.ending == ".svg" ? after_the_same : "",
        line_types(),
        "set border linewidth 1 linecolor rgb '#404040'\nset grid linetype 1 linecolor rgb '#e4e4e4' linewidth 0.6\n",
        "set output '", picture.path(), "'\n", body, "\nunset multiplot\nset output\n");
    std::string said, all;
    try {
        said = run(script);
        all = picture.contents();
        if (!is_whole(all, kind))
            throw FileError(path.string(), text("the picture is not complete: is the size of files limited, or "
                                                "does the script draw nothing or elsewhere?",
                                                said.empty() ? "" : "\n", said));
    } catch (...) {
        file.discard();
        throw;
    }
    file.complete(all);
    return said;
}

}  // namespace cardan::solvers
