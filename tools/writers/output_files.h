#pragma once

#include <deque>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

namespace swept {

/// All places a command will write to, opened together before the work begins: when one of them cannot be written,
/// whatever was newly created is taken away again, and a refused command leaves no trace.
class OutputFiles {
public:
    /// A file that must not be overwritten: what the command reads.
    void protect(const std::string& path);
    /// @param flag  the option that named it, for errors. An empty path is no output and is left out.
    void addFile(const std::string& flag, const std::string& path);
    /// The same, but "-" is standard output: for one file of a command, which then tells nothing else there. Whether
    /// that could be written is for the program to see, as ever.
    void addStream(const std::string& flag, const std::string& path);
    /// A directory for many files; it and its missing parents are created.
    /// @param writes  whether the command writes a file of this name there: then nothing else may be that file.
    void addDirectory(const std::string& flag, const std::string& path,
                      std::function<bool(const std::string& name)> writes = {});
    /// The first part of `open`, for files that are written later. @return false, and one line in `error`, when one of
    /// them is protected, two options name the same one, or one is standard output, which gets what the command tells
    /// (unless it is a stream).
    bool refuseClashes(std::string& error) const;
    /// @return false, and one line in `error`, when some place cannot be written, or of the reasons above.
    bool open(std::string& error);
    /// The open file of a path given to `addFile`; null for an empty path. Files written by others (pictures) are
    /// simply not asked for: they stay empty until the other overwrites them.
    std::ostream* stream(const std::string& path);
    /// Whether all that was written so far could be, as far as is known: what waits in buffers is not yet. Cheap.
    /// @return false, and one line in `error`, when something could not be written; of standard output the line is
    /// empty, since the program tells of that itself
    bool isWritten(std::string& error) const;
    /// Closes all files.
    /// @return false, and one line in `error`, when something could not be written (a full disk): then all is
    /// discarded.
    bool close(std::string& error);
    /// Closes and takes away all files, as none of them is complete, and those directories that `open` created and that
    /// are empty. What an earlier run left in a file is gone since `open` succeeded; where it did not, that stays.
    void discard();

private:
    struct Place {
        std::string flag;
        std::string path;
        std::ofstream stream;
        std::function<bool(const std::string& name)> writes{};  ///< of a directory
        bool isStandardOutput = false;                          ///< then nothing is opened, closed or taken away
    };
    static std::string incomplete(const Place& place);
    const Place* directoryWriting(const std::string& file) const;
    bool openDirectory(const Place& place, std::string& error);
    bool openFile(Place& place, std::string& error);

    std::vector<std::string> protected_;
    std::vector<Place> directories_;
    std::deque<Place> files_;  // a deque, as streams are handed out by address
    std::vector<std::string> created_;
    bool isBegun_ = false;  ///< files are cut off
};

}  // namespace swept
