//! What a trial leaves beside its record, and who may look on.

use std::io;
use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::sync::Arc;

use clap::Args;
use spatial_fetch::cli::{Common, Failure, Reporter, within};
use spatial_fetch::evaluation::write_trials;
use spatial_fetch::files::{Claims, refuse_existing};
use spatial_fetch::map::RoomMap;
use spatial_fetch::recording::{Live, Narration, Outputs, Stories, TruePiece};

#[derive(Args)]
#[group(skip)]
#[command(next_help_heading = "Outputs")]
pub struct Arguments {
    /// Draw the way through the rooms; {id} stands for the record's id
    #[arg(long, value_name = "FILE.svg")]
    plot: Option<PathBuf>,
    /// Write what the camera shows at the end, ID.png, into this folder
    #[arg(long, value_name = "DIR")]
    picture: Option<PathBuf>,
    /// Log the trial; {id} stands for the record's id
    #[arg(long, value_name = "FILE.mcap")]
    record: Option<PathBuf>,
    /// Write a page about all trials, DIR/index.html, with an animation of each
    #[arg(long, value_name = "DIR", conflicts_with = "serve")]
    report: Option<PathBuf>,
    /// Show the trials, one at a time and in real time, to Foxglove at this address (127.0.0.1:8765 where none is given; a build with the feature `live`)
    #[arg(long, value_name = "HOST:PORT", num_args = 0..=1, default_missing_value = "127.0.0.1:8765", conflicts_with = "serve")]
    live: Option<Address>,
    /// Show simulated trials so many times faster than real time
    #[arg(long, value_name = "TIMES", requires = "live", default_value_t = 1.0, value_parser = within(0.01..=10_000.0))]
    live_speed: f64,
}

impl Arguments {
    pub fn is_live(&self) -> bool {
        self.live.is_some()
    }

    /// Where a drawing is wanted.
    pub fn plot(&self) -> Option<&Path> {
        self.plot.as_deref()
    }

    /// Where the page about the trials is wanted; said before they are driven when it stands there already.
    pub fn page(&self, force: bool) -> Result<Option<PathBuf>, Failure> {
        let page = self.report.as_ref().map(|folder| folder.join("index.html"));
        page.iter().try_for_each(|page| refuse_existing(page, force))?;
        Ok(page)
    }

    pub fn outputs(self, common: &Common, options: String, reporter: &Reporter) -> Result<Outputs, Failure> {
        let live = self.live.as_ref().map(|address| address.serve(reporter)).transpose()?;
        let pace = live.is_some().then_some(self.live_speed);
        let narrator = reporter.clone();
        let told = common.verbose > 0 && !common.quiet;
        let narration =
            told.then(|| Narration { tell: Arc::new(move |text| narrator.tell(text)), figures: common.verbose > 1 });
        let stories = self.report.as_ref().map(|_| Arc::default());
        let (plot, picture, record, force) = (self.plot, self.picture, self.record, common.force);
        let claims = Claims::default();
        Ok(Outputs { plot, picture, record, live, pace, force, claims, options, narration, stories })
    }
}

/// Writes the page about the trials, where one is wanted.
pub fn write_page(
    page: Option<PathBuf>,
    stories: Option<Arc<Stories>>,
    map: &RoomMap,
    truth: &[TruePiece],
    force: bool,
) -> Result<(), Failure> {
    let (Some(page), Some(stories)) = (page, stories) else { return Ok(()) };
    Ok(write_trials(&page, stories.take(), map, truth, force)?)
}

/// Where Foxglove is served.
#[derive(Clone, Debug)]
struct Address {
    host: String,
    port: u16,
}

impl FromStr for Address {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts = text.rsplit_once(':').filter(|(host, _)| !host.is_empty());
        let parsed = parts.and_then(|(host, port)| Some(Self { host: host.to_string(), port: port.parse().ok()? }));
        parsed.ok_or_else(|| "not HOST:PORT, as 127.0.0.1:8765; name files before `--live`, or after `--`".to_string())
    }
}

impl Address {
    fn serve(&self, reporter: &Reporter) -> Result<Arc<Live>, Failure> {
        if cfg!(not(feature = "live")) {
            let what = "--live: this build has no server for Foxglove; build it with `--features live`";
            return Err(Failure::Usage(what.to_string()));
        }
        let Self { host, port } = self;
        let live = Live::serve(host, *port).map_err(|error| {
            let mend = match error.kind() {
                io::ErrorKind::AddrInUse => format!(
                    "; another program serves there: end it, or name another port, as `--live {host}:{}`",
                    port.checked_add(1).unwrap_or(8765)
                ),
                _ => "; name an address of this machine, as `--live 127.0.0.1:8765`".to_string(),
            };
            Failure::Failed(format!("--live {host}:{port}: {error}{mend}"))
        })?;
        reporter
            .remark(&format!("live at ws://{host}:{} (Foxglove: Open connection, Foxglove WebSocket)", live.port()));
        Ok(Arc::new(live))
    }
}
