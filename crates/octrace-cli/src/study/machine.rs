//! On what, and when.

use serde::Serialize;
use std::time::SystemTime;
use sysinfo::{CpuRefreshKind, RefreshKind, System};

/// The machine that measured.
#[derive(Clone, Debug, Serialize)]
pub struct Machine {
    /// The processor's name, as it gives it.
    pub cpu: String,
    /// Hardware threads that the program may use.
    pub hardware_threads: usize,
    /// Operating system and version.
    pub os: String,
    /// Instruction set.
    pub architecture: &'static str,
}

impl Machine {
    /// This one.
    pub fn this() -> Self {
        let system = System::new_with_specifics(RefreshKind::nothing().with_cpu(CpuRefreshKind::nothing()));
        let cpu = system.cpus().first().map(|cpu| cpu.brand().trim().to_owned());
        Self {
            cpu: cpu.filter(|name| !name.is_empty()).unwrap_or_else(|| "unknown processor".into()),
            hardware_threads: std::thread::available_parallelism().map_or(1, Into::into),
            os: System::long_os_version().unwrap_or_else(|| std::env::consts::OS.into()),
            architecture: std::env::consts::ARCH,
        }
    }
}

/// Date and time in UTC, as RFC 3339 writes it, to the second.
pub fn now() -> String {
    humantime::format_rfc3339_seconds(SystemTime::now()).to_string()
}
