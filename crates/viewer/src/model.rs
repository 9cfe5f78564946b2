//! A model file that is followed: what is shown of it now, and who waits for the next state.

use embate_files::preview::Preview;
use embate_files::view::ModelView;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;
use tokio::sync::watch;

/// A page that asks for a change has an answer after this time, whether there is one or not.
const WAIT: Duration = Duration::from_secs(10);

/// A model that is shown before it runs.
#[derive(Debug)]
pub struct ShownModel {
    path: PathBuf,
    current: Mutex<Arc<ModelView>>,
    versions: watch::Sender<usize>,
}

impl ShownModel {
    /// What was found of a model file.
    #[must_use]
    pub fn new(path: &Path, preview: Preview) -> Arc<Self> {
        let first = ModelView::new(path, preview, None);
        let (versions, _) = watch::channel(first.version);
        Arc::new(Self { path: path.into(), current: Mutex::new(Arc::new(first)), versions })
    }

    /// Shows what was found of the file after it changed.
    pub fn show(&self, preview: Preview) {
        let next = Arc::new(ModelView::new(&self.path, preview, Some(&self.current())));
        *self.current.lock().unwrap_or_else(PoisonError::into_inner) = next.clone();
        self.versions.send_replace(next.version);
    }

    /// What is shown now.
    pub(crate) fn current(&self) -> Arc<ModelView> {
        self.current.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// What is shown after the state `seen`, when there is something else; else what is shown a while later,
    /// or when the server ends.
    pub(crate) async fn after(&self, seen: usize, mut stopped: watch::Receiver<bool>) -> Arc<ModelView> {
        let mut versions = self.versions.subscribe();
        let changed = versions.wait_for(|version| *version != seen);
        let over = crate::server::over(&mut stopped);
        tokio::select! {
            _ = tokio::time::timeout(WAIT, changed) => {}
            () = over => {}
        }
        self.current()
    }
}
