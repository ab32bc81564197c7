// SPDX-License-Identifier: MIT
//
// A search of the text, not a parser: tags and their attributes are enough to refuse what is known to be read wrong.
#include "scenes/formats/assimp_faults.h"

#include <optional>

#include "scenes/formats/text.h"

namespace bvhbench {
namespace {

/// Calls `use` with the text of each opening tag called `name`, up to its '>', and with what follows. Stops if it returns false.
template <class Use>
void each_tag(std::string_view xml, const std::string& name, const Use& use)
{
    const std::string open = '<' + name;
    for (std::size_t at = xml.find(open); at != xml.npos; at = xml.find(open, at + 1)) {
        const std::size_t end = std::min(xml.find('>', at), xml.size());
        const char behind = xml[std::min(at + open.size(), xml.size() - 1)];
        if (behind != '>' && behind != '/' &&
            std::string_view(" \t\r\n").find(behind) == std::string_view::npos)
            continue;  // another tag, whose name begins so
        if (!use(xml.substr(at, end - at), xml.substr(std::min(end + 1, xml.size()))))
            return;
    }
}

/// Returns the value of an attribute in a tag; nothing if it has none.
std::optional<std::string_view> attribute(std::string_view tag, const std::string& name)
{
    for (const char quote : {'"', '\''}) {
        const std::string open = ' ' + name + '=' + quote;
        const std::size_t at = tag.find(open);
        if (at != tag.npos) {
            const std::size_t begin = at + open.size();
            return tag.substr(begin, tag.find(quote, begin) - begin);
        }
    }
    return std::nullopt;
}

std::int64_t number(std::string_view tag, const char* name, std::int64_t usual)
{
    return parse_integer(attribute(tag, name).value_or("")).value_or(usual);
}

std::size_t count_of_tags(std::string_view xml, const std::string& name)
{
    std::size_t count = 0;
    each_tag(xml, name, [&](std::string_view, std::string_view) { return ++count, true; });
    return count;
}

std::string fault_of_collada(std::string_view xml)
{
    std::string fault;
    for (const char* const name : {"trifans", "skew"})
        if (count_of_tags(xml, name) > 0)
            return "it has " + std::string(name) +
                   ", which assimp reads wrong: export it as triangles";
    for (const char* const name : {"instance_geometry", "instance_controller", "instance_node"})
        each_tag(xml, name, [&](std::string_view tag, std::string_view) {
            const std::string url(attribute(tag, "url").value_or(""));
            const bool is_there =
                url.starts_with('#') && (xml.find("id=\"" + url.substr(1) + '"') != xml.npos ||
                                         xml.find("id='" + url.substr(1) + '\'') != xml.npos);
            if (!is_there)
                fault = "it has an instance of " + in_quotes(url) + ", which is not in it";
            return is_there;
        });
    each_tag(xml, "p", [&](std::string_view, std::string_view behind) {
        if (behind.substr(0, behind.find('<')).find('-') != behind.npos)
            fault = "a triangle names a vertex below 0";
        return fault.empty();
    });
    each_tag(xml, "float_array", [&](std::string_view array, std::string_view behind) {
        const std::int64_t values = number(array, "count", 0);
        each_tag(behind.substr(0, behind.find("</source>")), "accessor",
                 [&](std::string_view tag, std::string_view) {
                     const std::int64_t count = number(tag, "count", 0),
                                        stride = number(tag, "stride", 1),
                                        offset = number(tag, "offset", 0);
                     if (stride < 1 || offset < 0 || count < 0 || count > values ||
                         (count > 0 && (count - 1) > (values - offset - 1) / stride) ||
                         (count > 0 && offset + (count - 1) * stride + 3 > values && stride >= 3))
                         fault = "it has an accessor of " + std::to_string(count) +
                                 " elements beyond the end of its array of " +
                                 std::to_string(values) + " numbers";
                     return fault.empty();
                 });
        return fault.empty();
    });
    return fault;
}

/// Returns how many files of a zip archive have a name that ends so, by its central directory.
std::size_t count_in_zip(std::string_view zip, std::string_view ending)
{
    constexpr std::string_view entry = "PK\1\2";
    constexpr std::size_t length_at = 28, name_at = 46;
    std::size_t count = 0;
    for (std::size_t at = zip.find(entry); at != zip.npos; at = zip.find(entry, at + 1)) {
        if (at + name_at > zip.size())
            break;
        const std::size_t length = static_cast<unsigned char>(zip[at + length_at]) +
                                   256u * static_cast<unsigned char>(zip[at + length_at + 1]);
        count += zip.substr(at + name_at, length).ends_with(ending) ? 1 : 0;
    }
    return count;
}

}  // namespace

std::string assimp_fault(std::string_view bytes, std::string_view extension)
{
    if (extension == ".dae")
        return fault_of_collada(bytes);
    if (extension == ".amf" && count_of_tags(bytes, "volume") > count_of_tags(bytes, "object"))
        return "it has objects of several volumes, and assimp reads one of each";
    if (extension == ".3mf" && count_in_zip(bytes, ".model") > 1)
        return "it has several model parts, and assimp reads one of them";
    return "";
}

}  // namespace bvhbench
