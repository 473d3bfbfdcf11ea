#include "solvers/pictures/detail/conversation.hpp"

#include "mbs/base/error.hpp"

#include <array>
#include <cerrno>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace cardan::solvers {

std::string system_reason(int number) {
    return std::generic_category().message(number);
}

namespace {

// @return what posix_spawnp says
int spawn(std::vector<std::string>& words, int socket, pid_t& child) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    for (const int end : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        posix_spawn_file_actions_adddup2(&actions, socket, end);
    std::vector<char*> arguments;
    arguments.reserve(words.size() + 1);
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const int code = ::posix_spawnp(&child, words.front().c_str(), &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    return code;
}

}  // namespace

Conversation::Conversation(std::vector<std::string> words) : program_(words.front()) {
    std::array<int, 2> ends{};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
        throw FileError(program_, text("cannot be spoken to: ", system_reason(errno)));
    const int code = spawn(words, ends[1], child_);
    ::close(ends[1]);
    socket_ = ends[0];
    if (code == 0) return;
    ::close(socket_);
    // EACCES for a bare name: a folder of PATH that may not be searched.
    if (code == ENOENT || (code == EACCES && program_.find('/') == std::string::npos))
        throw FileError(program_, "not found; pictures need gnuplot (Debian: apt install gnuplot-nox)");
    throw FileError(program_, text("cannot be run: ", system_reason(code)));
}

Conversation::~Conversation() {
    ::close(socket_);
    while (!ended_ && ::waitpid(child_, &status_, 0) < 0 && errno == EINTR) {
    }
}

void Conversation::say(std::string_view words) const {
    while (!words.empty()) {
        const ssize_t n = ::send(socket_, words.data(), words.size(), MSG_NOSIGNAL);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return;
        words.remove_prefix(static_cast<std::size_t>(n));
    }
}

bool Conversation::listen(const std::string& last, std::string& said, std::string& line) const {
    std::array<char, 4096> buffer{};
    while (true) {
        // It is the last thing that is said.
        if (said.ends_with('\n')) {
            const std::size_t before = said.find_last_of('\n', said.size() - 2);
            const std::size_t at = said.size() < 2 || before == std::string::npos ? 0 : before + 1;
            if (said.compare(at, last.size(), last) == 0) {
                line = said.substr(at, said.size() - 1 - at);
                said.erase(at);
                return true;
            }
        }
        const ssize_t n = ::recv(socket_, buffer.data(), buffer.size(), 0);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return false;
        said.append(buffer.data(), static_cast<std::size_t>(n));
    }
}

int Conversation::status() {
    while (!ended_) {
        if (::waitpid(child_, &status_, 0) >= 0)
            ended_ = true;
        else if (errno != EINTR)
            throw Error(text(program_, ": cannot be waited for: ", system_reason(errno)));
    }
    return status_;
}

}  // namespace cardan::solvers
