// SPDX-License-Identifier: MIT
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <string>
#include <vector>

namespace dynamic_filter::test {

/// A program that runs until the object or the test ends. Its output is appended to a file.
class ChildProcess {
public:
    ChildProcess(std::vector<std::string> command, const std::string& output) {
        std::vector<char*> arguments;
        for (std::string& word : command) arguments.push_back(word.data());
        arguments.push_back(nullptr);
        const int file = open(output.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
        pid_ = fork();
        if (pid_ == 0) {
            prctl(PR_SET_PDEATHSIG, SIGKILL);
            dup2(file, STDOUT_FILENO);
            dup2(file, STDERR_FILENO);
            execv(arguments[0], arguments.data());
            _exit(127);
        }
        close(file);
    }
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;
    ~ChildProcess() {
        if (pid_ <= 0) return;
        kill(pid_, SIGKILL);
        waitpid(pid_, nullptr, 0);
    }

    void send(int signal) const { kill(pid_, signal); }

private:
    pid_t pid_ = -1;
};

}  // namespace dynamic_filter::test
