//! Memory that a run may use.

/// Memory that the system can still give this process [bytes]; all of it where the system does not tell.
pub fn available_memory() -> u64 {
    let mut system = sysinfo::System::new();
    system.refresh_memory_specifics(sysinfo::MemoryRefreshKind::nothing().with_ram());
    let free = Some(system.available_memory()).filter(|&bytes| bytes > 0);
    free.unwrap_or(u64::MAX).min(address_space().unwrap_or(u64::MAX))
}

/// Limit on the memory of this process, such as batch systems set it [bytes], where there is one and the system tells.
fn address_space() -> Option<u64> {
    let limits = std::fs::read_to_string("/proc/self/limits").ok()?;
    let soft = limits.lines().find_map(|line| line.strip_prefix("Max address space"))?;
    soft.split_whitespace().next()?.parse().ok()
}
