// SPDX-License-Identifier: MIT
#include "harness/sweep/facts_worker.h"

#include <string_view>

#include "geometry/error.h"
#include "harness/failure.h"
#include "harness/number_text.h"
#include "harness/run.h"
#include "harness/session.h"
#include "scenes/worker/process.h"
#include "scenes/worker/worker.h"

namespace bvhbench {
namespace {

constexpr std::string_view argument = "--run-facts";
constexpr std::string_view refusal_mark = "ERROR 1\n";
constexpr double time_limit_s = 600;  ///< compiling its two kernels has taken a driver a minute

}  // namespace

bool is_facts_worker(int argc, char** argv) { return argc >= 2 && argv[1] == argument; }

int facts_worker_main(int argc, char** argv)
{
    end_with_parent();
    const int answer = take_standard_output();
    std::string text;
    try {
        const Options options = parse_options(argc - 1, argv + 1);
        Session session(options.common);
        text = document_text(run_text(measured_facts(session, {})), {});
    } catch (const std::exception& error) {
        text = std::string(refusal_mark) + sentence_of(error);
    }
    return write_all(answer, text) ? 0 : 1;
}

std::vector<std::string> common_words(const CommonOptions& common, const std::string& device)
{
    std::vector<std::string> words;
    const auto add = [&words](const char* option, const std::string& value) {
        words.insert(words.end(), {option, value});
    };
    if (!device.empty())
        add("--device", device);
    if (!common.kernels.empty())
        add("--kernels", common.kernels);
    if (!common.data.empty())
        add("--data", common.data);
    if (common.doubles != CommonOptions{}.doubles)
        add("--doubles", common.doubles);
    if (common.tuning)
        add("--tuning", *common.tuning);
    if (common.memory_limit > 0)
        add("--memory-limit", std::to_string(common.memory_limit));
    if (common.time_limit_s != CommonOptions{}.time_limit_s)
        add("--time-limit", number_text(common.time_limit_s));
    return words;
}

RunFacts facts_of_device(const CommonOptions& common, const std::string& device)
{
    std::vector<std::string> words = {"/proc/self/exe", std::string(argument), "list", "devices"};
    for (std::string& word : common_words(common, device))
        words.push_back(std::move(word));
    const ProcessEnd end = run_process(words, time_limit_s, "BVHBENCH_FACTS_WORKER=1");
    if (end.how != ProcessEnd::How::exited || end.code != 0)
        throw Unavailable("the process that opens the device " + spelled(end, time_limit_s));
    if (end.output.starts_with(refusal_mark))
        throw Unavailable(end.output.substr(refusal_mark.size()));
    return read_document(end.output, "what the process that opens the device says").run;
}

}  // namespace bvhbench
