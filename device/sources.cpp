// SPDX-License-Identifier: MIT
#include "device/sources.h"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

#include "geometry/error.h"

namespace bvhbench {
namespace {

/// Returns the quoted path of an #include line, or nothing for other lines.
std::optional<std::string> included_path(const std::string& line)
{
    const std::size_t hash = line.find_first_not_of(" \t");
    if (hash == std::string::npos || line.compare(hash, 8, "#include") != 0)
        return std::nullopt;
    const std::size_t open = line.find('"', hash);
    const std::size_t close = open == std::string::npos ? open : line.find('"', open + 1);
    if (close == std::string::npos)
        return std::nullopt;
    return line.substr(open + 1, close - open - 1);
}

template <class Read>
void append(std::string& out, std::set<std::string>& seen, const std::string& path,
            const Read& read)
{
    if (!seen.insert(path).second)
        return;
    const std::optional<std::string> text = read(path);
    if (!text)
        throw Unavailable("kernel source '" + path + "' is not there");

    std::istringstream lines(*text);
    std::string line;
    out += "#line 1 \"" + path + "\"\n";
    for (int number = 1; std::getline(lines, line); ++number) {
        if (const auto included = included_path(line)) {
            append(out, seen, *included, read);
            out += "#line " + std::to_string(number + 1) + " \"" + path + "\"\n";
        } else {
            out += line + '\n';
        }
    }
}

}  // namespace

Sources Sources::embedded()
{
    return {"embedded", [](std::string_view path) -> std::optional<std::string> {
                if (const auto text = embedded_kernel(path))
                    return std::string(*text);
                return std::nullopt;
            }};
}

Sources Sources::tree(std::filesystem::path root)
{
    return {root.string(), [root](std::string_view path) -> std::optional<std::string> {
                std::ifstream file(root / path, std::ios::binary);
                if (!file)
                    return std::nullopt;
                return std::string(std::istreambuf_iterator<char>(file), {});
            }};
}

Sources Sources::preferred()
{
    const char* root = std::getenv("BVHBENCH_KERNELS");
    return root != nullptr && *root != '\0' ? tree(root) : embedded();
}

std::string Sources::flatten(std::initializer_list<std::string_view> paths) const
{
    std::string out;
    std::set<std::string> seen;
    for (const std::string_view path : paths)
        append(out, seen, std::string(path), read_);
    return out;
}

}  // namespace bvhbench
