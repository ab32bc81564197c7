// SPDX-License-Identifier: MIT
#include "harness/choice/filter_words.h"

#include <re2/re2.h>

#include <algorithm>
#include <iterator>
#include <sstream>
#include <utility>
#include <vector>

#include "geometry/error.h"
#include "harness/base/json_keys.h"

namespace bvhbench {
namespace {

constexpr uint all_bits = ~0u;
constexpr std::size_t most_named = 12;  ///< objects that an error names

std::vector<std::string> words_of(const std::string& exclude)
{
    std::vector<std::string> words;
    std::istringstream text(exclude);
    for (std::string word; std::getline(text, word, ';');)
        if (std::string trimmed; RE2::FullMatch(word, "\\s*(\\S.*?)\\s*", &trimmed))
            words.push_back(trimmed);
    return words;
}

bool is_pair(const std::string& word, std::string& a, std::string& b)
{
    return RE2::FullMatch(word, "([^,]*[^,\\s])\\s*,\\s*([^,]+)", &a, &b);
}

class Reader {
public:
    explicit Reader(const Scene& scene) : scene_(scene) {}

    void exclude(const std::string& a, const std::string& b, const std::string& where)
    {
        filter_.excluded.push_back({object(a, where), object(b, where)});
    }

    void read_file(const std::string& path)
    {
        std::istringstream text(file_text(path, "the filter file"));
        std::size_t number = 0;
        for (std::string line; std::getline(text, line);)
            read_line(line.substr(0, line.find('#')), path + ':' + std::to_string(++number) + ": ");
    }

    ObjectFilter taken()
    {
        filter_.excluded = excluded_pairs(std::move(filter_.excluded));
        return std::move(filter_);
    }

private:
    void read_line(const std::string& line, const std::string& where)
    {
        std::istringstream text(line);
        const std::vector<std::string> words{std::istream_iterator<std::string>(text), {}};
        uint group = 0, mask = 0;
        if (words.empty())
            return;
        if (words.size() == 3 && words[0] == "exclude")
            exclude(words[1], words[2], where);
        else if (words.size() == 4 && words[0] == "group" && read_bits(words[2], group) &&
                 read_bits(words[3], mask))
            set_masks(object(words[1], where), group, mask);
        else
            throw BadUsage(where +
                           "a line is 'exclude A B' or 'group A WORD MASK', of 32 bits, not '" +
                           line + '\'');
    }

    static bool read_bits(const std::string& word, uint& bits)
    {
        return RE2::FullMatch(word, "0[xX]([0-9a-fA-F]+)", RE2::Hex(&bits)) ||
               RE2::FullMatch(word, "(\\d+)", &bits);
    }

    void set_masks(uint object, uint group, uint mask)
    {
        filter_.groups.resize(scene_.objects.size(), all_bits);
        filter_.masks.resize(scene_.objects.size(), all_bits);
        filter_.groups[object] = group;
        filter_.masks[object] = mask;
    }

    std::int64_t number_of(std::size_t object) const
    {
        return scene_.object_ids.empty() ? static_cast<std::int64_t>(object)
                                         : scene_.object_ids[object];
    }

    /// Returns the object called `text`, by name before number.
    uint object(const std::string& text, const std::string& where) const
    {
        const auto is_called = [&](const SceneObject& one) { return one.name == text; };
        const auto named = std::ranges::find_if(scene_.objects, is_called);
        if (named != scene_.objects.end()) {
            if (const auto count = std::ranges::count_if(scene_.objects, is_called); count > 1)
                throw BadUsage(where + std::to_string(count) + " objects of scene '" + scene_.name +
                               "' are called '" + text + "': give the number of one");
            return static_cast<uint>(named - scene_.objects.begin());
        }
        std::int64_t number = 0;
        if (RE2::FullMatch(text, "(\\d+)", &number))
            for (uint k = 0; k < scene_.objects.size(); ++k)
                if (number_of(k) == number)
                    return k;
        std::string known;
        for (std::size_t k = 0; k < std::min(most_named, scene_.objects.size()); ++k)
            known += (k > 0 ? ", " : "") + std::to_string(number_of(k)) + " '" +
                     scene_.objects[k].name + '\'';
        throw BadUsage(where + "scene '" + scene_.name + "' has no object '" + text + "'; it has " +
                       std::to_string(scene_.objects.size()) + ": " + known +
                       (scene_.objects.size() > most_named ? ", ..." : ""));
    }

    const Scene& scene_;
    ObjectFilter filter_;
};

}  // namespace

bool add_exclude_words(std::string& exclude, std::string_view words)
{
    std::string added = exclude, a, b;
    for (const std::string& word : words_of(std::string(words))) {
        if (!is_pair(word, a, b) && !RE2::FullMatch(word, "@.+"))
            return false;
        added += (added.empty() ? "" : "; ") + word;
    }
    exclude = added;
    return true;
}

ObjectFilter filter_of(const std::string& exclude, const Scene& scene)
{
    Reader reader(scene);
    std::string a, b;
    for (const std::string& word : words_of(exclude))
        if (word.starts_with('@'))
            reader.read_file(word.substr(1));
        else if (is_pair(word, a, b))
            reader.exclude(a, b, "'exclude' " + word + ": ");
    return reader.taken();
}

}  // namespace bvhbench
