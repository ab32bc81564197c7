// SPDX-License-Identifier: MIT
#include "plugins/worker.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "plugins/loaded.h"
#include "process/worker.h"

namespace bvhbench::outside {
namespace {

constexpr std::string_view argument = "--outside";
constexpr std::string_view as_program = "program", as_library = "library";

std::string line_of(const Json& reply)
{
    return reply.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string error_line(const std::string& what) { return line_of({{"error", what}}); }

/// Speaks the protocol for the library until it is told to quit.
int serve(const char* path, int answers)
{
    std::function<Json(const Json&)> reply_to;
    for (std::string line; std::getline(std::cin, line);) {
        std::string answer;
        try {
            const Json request = Json::parse(line);
            if (request.at("call") == "quit")
                break;
            if (!reply_to)
                reply_to = loaded_library(path);
            answer = line_of(reply_to(request));
        } catch (const std::exception& error) {
            answer = error_line(error.what());
        }
        if (!write_all(answers, answer))
            return 1;
    }
    return 0;
}

}  // namespace

std::vector<std::string> worker_words(const Library& library)
{
    return {"bvhbench", std::string(argument),
            std::string(library.is_program ? as_program : as_library), library.file};
}

bool is_worker(int argc, char** argv) { return argc == 4 && argv[1] == argument; }

int worker_main(int, char** argv)
{
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    if (argv[2] == as_program) {
        execl(argv[3], argv[3], nullptr);
        const std::string reason = std::system_category().message(errno);
        write_all(STDOUT_FILENO, error_line("it cannot be started: " + reason));
        return 1;
    }
    const int answers = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
    dup2(STDERR_FILENO, STDOUT_FILENO);  // what the library prints is kept with its errors
    return serve(argv[3], answers);
}

}  // namespace bvhbench::outside
