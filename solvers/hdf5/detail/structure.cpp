#include "solvers/hdf5/detail/structure.hpp"

#include "solvers/hdf5/detail/file.hpp"
#include "solvers/hdf5/detail/journal.hpp"

#include <hdf5.h>

#include <array>
#include <cstring>
#include <fstream>
#include <optional>

namespace cardan::solvers::detail {
namespace {

#if H5_VERS_MINOR < 12
using ObjectInfo = H5O_info_t;
#else
using ObjectInfo = H5O_info1_t;
#endif

constexpr std::uint64_t undefined = ~std::uint64_t{0};

/// Bytes of the file, little-endian, read in order. Reading past the end throws a FileError: the file is damaged.
class Bytes {
public:
    Bytes(const Hdf5File::Impl& impl, const std::string& name, std::uint64_t address, std::uint64_t size)
        : impl_(impl), name_(name) {
        constexpr std::uint64_t max = std::uint64_t{1} << 28;
        const std::uint64_t end = impl.journal->size();
        if (size > max || address > end || size > end - address) damaged("a part lies behind the end of the file");
        bytes_.resize(size);
        if (impl.journal->read(address, bytes_) != 0) damaged("a part cannot be read");
    }
    std::uint64_t number(int bytes) {
        std::uint64_t value = 0;
        for (int k = 0; k < bytes; ++k) value |= std::uint64_t{static_cast<unsigned char>(next())} << (8 * k);
        return value;
    }
    void expect(std::string_view signature) {
        for (const char c : signature)
            if (next() != c) damaged("a part is not where it should be");
    }
    void skip(std::uint64_t count) {
        if (count > left()) damaged("a part is too short");
        at_ += count;
    }
    [[nodiscard]] std::uint64_t left() const { return bytes_.size() - at_; }
    [[noreturn]] void damaged(std::string_view what) const {
        throw FileError(impl_.path, text(name_, ": the file is damaged: ", what));
    }

private:
    char next() {
        if (left() == 0) damaged("a part is too short");
        return bytes_[at_++];
    }
    const Hdf5File::Impl& impl_;
    const std::string& name_;
    std::vector<char> bytes_;
    std::uint64_t at_ = 0;
};

/// How a data set is cut into chunks.
struct Layout {
    std::uint64_t tree = undefined;  ///< address of the index
    std::uint64_t chunk = 0;         ///< values
};

/// Goes through the messages of a header; the C library has been here and verified the checksums.
class Header {
public:
    Header(const Hdf5File::Impl& impl, const std::string& name) : impl_(impl), name_(name) {}

    Layout layout(std::uint64_t address) {
        constexpr std::uint64_t longest_prefix = 4 + 2 + 16 + 4 + 8;
        Bytes prefix(impl_, name_, address, 6);
        prefix.expect("OHDR");
        if (prefix.number(1) != 2) prefix.damaged("a header of another version");
        const std::uint64_t flags = prefix.number(1);
        ordered_ = (flags & 0x04) != 0;
        const std::uint64_t before = 6 + ((flags & 0x20) != 0 ? 16U : 0U) + ((flags & 0x10) != 0 ? 4U : 0U);
        const int width = 1 << (flags & 3);
        Bytes start(impl_, name_, address, std::min<std::uint64_t>(before + 8, longest_prefix));
        start.skip(before);
        parts_ = {{address + before + static_cast<std::uint64_t>(width), start.number(width)}};
        constexpr std::size_t max_parts = 10000;
        for (std::size_t k = 0; k < parts_.size() && k < max_parts && !found_; ++k) part(parts_[k]);
        if (!found_) start.damaged("its header does not say where its values are");
        return *found_;
    }

private:
    struct Part {
        std::uint64_t address, size;
    };

    void part(Part where) {
        Bytes bytes(impl_, name_, where.address, where.size);
        const std::uint64_t head = ordered_ ? 6 : 4;
        while (bytes.left() >= head && !found_) {
            const std::uint64_t type = bytes.number(1), size = bytes.number(2);
            bytes.skip(head - 3);
            if (type == 0x10) {
                continuation(bytes);
                bytes.skip(size - 16);
            } else if (type == 0x08) {
                found_ = chunked(bytes);
            } else {
                bytes.skip(size);
            }
        }
    }

    void continuation(Bytes& bytes) {
        const std::uint64_t address = bytes.number(8), size = bytes.number(8);
        constexpr std::uint64_t signature = 4, checksum = 4;
        if (size < signature + checksum) bytes.damaged("a part is too short");
        Bytes(impl_, name_, address, size).expect("OCHK");
        parts_.push_back({address + signature, size - signature - checksum});
    }

    static Layout chunked(Bytes& bytes) {
        if (bytes.number(1) != 3 || bytes.number(1) != 2 || bytes.number(1) != 2)
            bytes.damaged("its values are not in chunks of one axis");
        Layout layout;
        layout.tree = bytes.number(8);
        layout.chunk = bytes.number(4);
        if (bytes.number(4) != sizeof(double) || layout.chunk == 0) bytes.damaged("its values are not doubles");
        return layout;
    }

    const Hdf5File::Impl& impl_;
    const std::string& name_;
    bool ordered_ = false;
    std::vector<Part> parts_;
    std::optional<Layout> found_;
};

/// Goes through the index from left to right; chunks must come one after the other.
class ChunkTree {
public:
    ChunkTree(const Hdf5File::Impl& impl, const std::string& name, std::uint64_t chunk)
        : impl_(impl), name_(name), chunk_(chunk) {}

    /// @param level  of the node; none: of the root, which may have any
    void walk(std::uint64_t address, std::optional<std::uint64_t> level) {
        Bytes node(impl_, name_, address, node_size);
        node.expect("TREE");
        if (node.number(1) != 1) node.damaged("the index is not one of chunks");
        const std::uint64_t own = node.number(1), entries = node.number(2);
        if (own > highest || (level && own != *level)) node.damaged("a node of the index has a wrong level");
        if (entries > max_entries || (entries == 0 && level)) node.damaged("a node of the index has a wrong length");
        node.skip(16);  // neighbours, which are not asked for
        for (std::uint64_t k = 0; k < entries; ++k) {
            const std::uint64_t bytes = key(node, false), child = node.number(8);
            if (own > 0)
                walk(child, own - 1);
            else
                take(node, child, bytes);
        }
        if (entries > 0) key(node, true);
    }

    [[nodiscard]] std::uint64_t chunks() const { return chunks_; }

private:
    static constexpr std::uint64_t max_entries = 64, highest = 8, key_size = 24;
    static constexpr std::uint64_t node_size = 24 + max_entries * (key_size + 8) + key_size;
    static constexpr std::uint64_t checksum_size = 4, only_without_deflate = 2;

    // Bytes of the chunk that the key stands for. The last key of a node stands for none and lies behind the last
    // chunk, which is one of element 0.
    std::uint64_t key(Bytes& node, bool last) {
        const std::uint64_t bytes = node.number(4);
        mask_ = node.number(4);
        const std::uint64_t row = node.number(8), element = node.number(8), next = chunks_ * chunk_;
        const bool behind = element == sizeof(double) ? row + chunk_ >= next : element == 0 && row >= next;
        const bool good = last ? behind && row % chunk_ == 0 : row == next && element == 0;
        if (!good) node.damaged("the index of its chunks is out of order");
        return bytes;
    }

    void take(const Bytes& node, std::uint64_t address, std::uint64_t bytes) {
        const std::uint64_t plain = chunk_ * sizeof(double) + checksum_size;
        const bool filtered = mask_ == 0 || (mask_ == only_without_deflate && bytes == plain);
        if (!filtered) node.damaged("a chunk without checksum");
        const std::uint64_t end = impl_.journal->size();
        if (bytes <= checksum_size || address > end || bytes > end - address)
            node.damaged("a chunk lies behind the end of the file");
        ++chunks_;
    }

    const Hdf5File::Impl& impl_;
    const std::string& name_;
    std::uint64_t chunk_, chunks_ = 0, mask_ = 0;
};

}  // namespace

void check_beginning(const std::string& path) {
    constexpr std::string_view signature("\x89HDF\r\n\x1a\n", 8);
    std::array<char, 9> start{};
    const auto has_signature = [&] { return std::string_view(start.data(), signature.size()) == signature; };
    std::ifstream(path, std::ios::binary).read(start.data(), start.size());
    if (JournaledFile journal; !has_signature() && journal.open(path.c_str(), JournaledFile::Mode::read) == 0)
        if (journal.read(0, start) != 0) start.fill('\0');  // a flush goes on, or was broken off
    if (!has_signature()) throw FileError(path, "cannot be opened as an HDF5 file: file signature not found");
    if (const int version = static_cast<unsigned char>(start.back()); version != 2)
        throw FileError(path, text("is an HDF5 file, but no history: its format has the version ", version,
                                   "; that of histories has 2"));
}

void check_chunks(const Hdf5File& file, const std::string& name) {
    const Quiet quiet;
    const Hdf5File::Impl& impl = Hdf5File::Impl::of(file);
    const Handle dataset = impl.open_dataset(name);
    const Shape shape = impl.shape(dataset.get(), name);
    ObjectInfo info{};
    impl.ok(H5Oget_info2(dataset.get(), &info, H5O_INFO_BASIC), name, "be read");
    const Layout layout = Header(impl, name).layout(info.addr);
    ChunkTree tree(impl, name, layout.chunk);
    if (layout.tree != undefined) tree.walk(layout.tree, std::nullopt);
    const std::uint64_t needed = shape.empty() ? 0 : (shape.front() + layout.chunk - 1) / layout.chunk;
    if (tree.chunks() < needed)
        throw FileError(impl.path, text(name, ": the file is damaged: ", tree.chunks(), " of ", needed, " chunks"));
}

}  // namespace cardan::solvers::detail
