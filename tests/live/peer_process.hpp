// SPDX-License-Identifier: MIT
/// A program at the other end of the wire, which ends with the test at the latest.
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstddef>
#include <mutex>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace dynamic_filter::live {

class PeerProcess {
public:
    explicit PeerProcess(std::vector<std::string> command) {
        int in[2], out[2];
        if (pipe2(in, O_CLOEXEC) != 0 || pipe2(out, O_CLOEXEC) != 0)
            throw std::runtime_error("pipe");
        std::vector<char*> words;
        for (std::string& word : command) words.push_back(word.data());
        words.push_back(nullptr);
        process_ = fork();
        if (process_ == 0) {
            prctl(PR_SET_PDEATHSIG, SIGKILL);
            dup2(in[0], STDIN_FILENO);
            dup2(out[1], STDOUT_FILENO);
            execv(words[0], words.data());
            _exit(127);
        }
        close(in[0]);
        close(out[1]);
        input_ = in[1];
        reader_ = std::thread([this, output = out[0]] { read_lines(output); });
        signal(SIGPIPE, SIG_IGN);
    }
    PeerProcess(const PeerProcess&) = delete;
    PeerProcess& operator=(const PeerProcess&) = delete;
    ~PeerProcess() {
        end_input();
        kill(process_, SIGKILL);
        if (reader_.joinable()) wait();
    }

    void write(std::span<const std::byte> bytes) {
        while (!bytes.empty()) {
            const ssize_t n = ::write(input_, bytes.data(), bytes.size());
            if (n <= 0) return;
            bytes = bytes.subspan(static_cast<std::size_t>(n));
        }
    }
    void write(const std::string& text) { write(std::as_bytes(std::span(text))); }
    void end_input() {
        if (input_ >= 0) close(std::exchange(input_, -1));
    }
    void kill_now() { kill(process_, SIGKILL); }
    /// Waits for the end of the process. Returns its exit code, or -1 if it was killed.
    int wait() {
        int status = 0;
        waitpid(process_, &status, 0);
        reader_.join();
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

    /// What stands behind `word` in the lines of the output that begin with it.
    std::vector<std::string> said(const std::string& word) {
        const std::lock_guard hold(lock_);
        std::vector<std::string> found;
        for (const std::string& line : lines_) {
            if (line == word) found.emplace_back();
            if (line.starts_with(word + " ")) found.push_back(line.substr(word.size() + 1));
        }
        return found;
    }

private:
    void read_lines(int output) {
        std::string text;
        char buffer[4096];
        for (ssize_t n = 0; (n = read(output, buffer, sizeof buffer)) > 0;) {
            text.append(buffer, static_cast<std::size_t>(n));
            const std::lock_guard hold(lock_);
            for (std::size_t end = 0; (end = text.find('\n')) != std::string::npos;) {
                lines_.push_back(text.substr(0, end));
                text.erase(0, end + 1);
            }
        }
        close(output);
    }

    pid_t process_ = 0;
    int input_ = -1;
    std::thread reader_;
    std::mutex lock_;
    std::vector<std::string> lines_;
};

}  // namespace dynamic_filter::live
