/// @file
/// A child process that reads commands and answers.
#pragma once

#include <string>
#include <string_view>
#include <sys/types.h>
#include <vector>

namespace cardan::solvers {

/// Text of the system on an error number.
std::string system_reason(int number);

/// Runs a program whose standard input, output and errors are one socket; it ends when the object goes away.
class Conversation {
public:
    /// @param words  the program, a name looked up in PATH or a path, and its arguments
    /// @throws FileError if there is no such program, or it cannot be run
    explicit Conversation(std::vector<std::string> words);
    Conversation(const Conversation&) = delete;
    Conversation& operator=(const Conversation&) = delete;
    Conversation(Conversation&&) = delete;
    Conversation& operator=(Conversation&&) = delete;
    ~Conversation();

    /// A program that has ended hears nothing: listen() says so.
    void say(std::string_view words) const;
    /// Appends what the program says until its last line begins with `last`, which is cut off and returned without its
    /// end.
    /// @return  false if the program ended before; see status()
    bool listen(const std::string& last, std::string& said, std::string& line) const;
    /// Waits for the end of the program. @return what waitpid says
    int status();

private:
    std::string program_;
    int socket_ = -1;
    pid_t child_ = 0;
    bool ended_ = false;
    int status_ = 0;
};

}  // namespace cardan::solvers
