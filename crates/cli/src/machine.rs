//! The machine that the program runs on: its processor and its memory, as far as the system reports.

/// Name of the processor; empty where the system does not report it.
pub(crate) fn processor() -> String {
    let text = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let line = text.lines().find_map(|line| line.strip_prefix("model name")?.split_once(':').map(|(_, name)| name.trim().to_string()));
    line.unwrap_or_default()
}

/// Processors that this process may use.
pub(crate) fn processors() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// Memory that programs can have now, bytes; `None` where the system does not report it.
pub(crate) fn memory_available() -> Option<u64> {
    kibibytes("/proc/meminfo", "MemAvailable:")
}

/// Memory that this process has in use, bytes; `None` where the system does not report it.
pub(crate) fn memory_used() -> Option<u64> {
    kibibytes("/proc/self/status", "VmRSS:")
}

/// A line such as `VmRSS:   1234 kB`, in bytes.
fn kibibytes(file: &str, name: &str) -> Option<u64> {
    let text = std::fs::read_to_string(file).ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix(name))?;
    Some(line.split_whitespace().next()?.parse::<u64>().ok()? << 10)
}
