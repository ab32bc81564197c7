// SPDX-License-Identifier: MIT
#include "harness/stress/report.h"

#include <algorithm>

#include "harness/table.h"

namespace bvhbench {
namespace {

using enum Finding::Verdict;
using enum Table::Align;

/// A list without repetitions, in the order of the first ones.
void add_once(std::vector<std::string>& list, const std::string& word)
{
    if (std::find(list.begin(), list.end(), word) == list.end())
        list.push_back(word);
}

/// "right", "-12 +3" for pairs that were missed or are false, "12 wrong", "wrong", "refused"
std::string text_of(Invariant invariant, const Finding& finding)
{
    if (finding.verdict != broken)
        return finding.verdict == holds ? "right" : "refused";
    if (invariant == Invariant::ends)
        return "failed";
    if (invariant == Invariant::pairs || invariant == Invariant::contacts)
        return "-" + grouped(static_cast<std::int64_t>(finding.missed)) + " +" +
               grouped(static_cast<std::int64_t>(finding.wrong - finding.missed));
    return finding.wrong > 0 ? grouped(static_cast<std::int64_t>(finding.wrong)) + " wrong"
                             : "wrong";
}

/// Of one system over a scene.
std::string verdict_of(const StressCell& cell)
{
    for (const Finding::Verdict verdict : {broken, refused})
        for (const auto& [invariant, finding] : cell.findings)
            if (finding.verdict == verdict)
                return text_of(invariant, finding);
    return cell.findings.empty() ? "" : "right";
}

/// Of several: "21 right", "20 right, 1 wrong".
class Tally {
public:
    void add(const StressCell& cell)
    {
        const std::string verdict = verdict_of(cell);
        ++(verdict == "right" ? right_ : verdict == "refused" ? refused_ : wrong_);
    }
    std::string text() const
    {
        std::string text;
        const auto put = [&](int count, const char* word) {
            if (count > 0)
                text += (text.empty() ? "" : ", ") + std::to_string(count) + word;
        };
        put(right_, " right");
        put(refused_, " refused");
        put(wrong_, " wrong");
        return text;
    }

private:
    int right_ = 0, refused_ = 0, wrong_ = 0;
};

std::string with_version(const std::string& name,
                         const std::map<std::string, std::string>& versions)
{
    const auto version = versions.find(name);
    return version == versions.end() ? name : name + ' ' + version->second;
}

std::string scenes_table(const std::vector<StressCell>& cells)
{
    std::vector<std::string> rows, libraries;
    for (const StressCell& cell : cells) {
        add_once(rows, cell.family + ": " + cell.scene);
        if (cell.kind == StressCell::Kind::library)
            add_once(libraries, cell.system);
    }
    std::vector<Table::Column> columns = {
        {"scene", left}, {"triangles"}, {"ours", left}, {"wrapped libraries", left}};
    for (const std::string& library : libraries)
        columns.push_back({library, left});
    Table table(columns);
    for (const std::string& row : rows) {
        Tally ours, wrapped;
        std::int64_t triangles = 0;
        std::map<std::string, std::string> by_library;
        for (const StressCell& cell : cells) {
            if (cell.family + ": " + cell.scene != row)
                continue;
            triangles = std::max(triangles, cell.triangles);
            if (cell.kind == StressCell::Kind::library)
                by_library[cell.system] = verdict_of(cell);
            else
                (cell.library.empty() ? ours : wrapped).add(cell);
        }
        std::vector<std::string> entries = {row, triangles > 0 ? grouped(triangles) : "",
                                            ours.text(), wrapped.text()};
        for (const std::string& library : libraries)
            entries.push_back(by_library[library]);
        table.row(std::move(entries));
    }
    return table.text();
}

std::string systems_table(const std::vector<StressCell>& cells,
                          const std::map<std::string, std::string>& versions)
{
    std::vector<Table::Column> columns = {{"system", left}, {"scenes"}};
    for (const char* name : invariant_names)
        columns.push_back({name, left});
    columns.push_back({"", left});
    Table table(columns);
    std::vector<std::string> systems;
    for (const StressCell& cell : cells)
        add_once(systems, cell.system);
    for (const std::string& system : systems) {
        int scenes = 0;
        Findings all;
        std::string library;
        for (const StressCell& cell : cells)
            if (cell.system == system) {
                ++scenes;
                join(all, cell.findings);
                library = cell.library;
            }
        std::vector<std::string> entries = {system, std::to_string(scenes)};
        for (std::size_t k = 0; k < invariant_names.size(); ++k) {
            const auto found = all.find(static_cast<Invariant>(k));
            entries.push_back(found == all.end() ? "" : text_of(found->first, found->second));
        }
        entries.push_back(library.empty() ? "" : with_version(library, versions));
        table.row(std::move(entries));
    }
    return table.text();
}

}  // namespace

std::string stress_report(const std::vector<StressCell>& cells,
                          const std::map<std::string, std::string>& versions)
{
    std::string text = scenes_table(cells) + '\n' + systems_table(cells, versions) + '\n';
    std::size_t ours = 0, wrong = 0, refusals = 0;
    const auto tell = [&](const char* word, const StressCell& cell, Finding::Verdict verdict) {
        for (const auto& [invariant, finding] : cell.findings)
            if (finding.verdict == verdict)
                text += word + cell.family + ": " + cell.scene + ", " + cell.system + ", " +
                        std::string(name_of(invariant)) + ": " + finding.detail + '\n';
    };
    for (const StressCell& cell : cells) {
        if (!cell.library.empty())
            continue;
        ++ours;
        if (is_our_fault(cell)) {
            ++wrong;
            tell("WRONG ", cell, broken);
        } else if (cell.kind != StressCell::Kind::host && verdict_of(cell) == "refused") {
            ++refusals;  // of the host, that is what was to be done
            tell("refused ", cell, refused);
        }
    }
    text += std::to_string(ours) + " cells of ours, " +
            (wrong > 0      ? std::to_string(wrong) + " wrong"
             : refusals > 0 ? "none wrong"
                            : "all right");
    return text + (refusals > 0 ? ", " + std::to_string(refusals) + " refused\n" : "\n");
}

}  // namespace bvhbench
