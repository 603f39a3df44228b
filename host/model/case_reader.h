#pragma once
// A case file as its tables, read key by key. Every fault is collected instead of stopping at the first. A key that was
// never asked for is an unknown key. The values that were given out are the resolved case.

#include <filesystem>
#include <list>
#include <span>
#include <string>
#include <vector>

#include "host/core/key.h"
#include "host/model/case_tree.h"
#include "host/model/section.h"

namespace vkdose {

class CaseReader {
  public:
    /// `tables` declare every key that the file may hold. They must outlive the reader.
    CaseReader(std::string file, Node tree, std::span<const KeyTable> tables);

    Section& root() { return sections_.front(); }

    /// Reports a fault of the key at `path` ("coil.radius_mm"). The message names the line of the key, or the line of
    /// its table if the value is a default.
    void fault(const std::string& path, std::string problem, std::string remedy);
    void add(Diagnostic fault) { faults_.push_back(std::move(fault)); }

    bool faulty() const { return !faults_.empty(); }
    /// Reports the keys that were never asked for. Call once, after reading.
    void finish();
    /// Throws CaseError when there are faults.
    void throwIfFaulty() const;

    /// The case as TOML, every key as it was used.
    std::string resolved() const;

    /// The file that states the key at `path`, or its table if the value is a default.
    const std::string& fileOf(const std::string& path) const;
    /// Folder to which a relative path in the value at `path` refers.
    std::filesystem::path folderOf(const std::string& path) const;

  private:
    friend class Section;
    const Node* find(const std::string& path, const Node** nearest) const;
    Section* opened(const std::string& path);
    Section& open(const Node* node, std::string path, bool broken);

    std::string file_;
    Node tree_;
    std::span<const KeyTable> tables_;
    std::list<Section> sections_;  ///< a list: references stay valid
    std::vector<Diagnostic> faults_;
};

}  // namespace vkdose
