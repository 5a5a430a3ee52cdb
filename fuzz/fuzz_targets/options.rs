#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| spatial_fetch_fuzz::options(data));
