//! `serve`: the page, with jobs run by this program, on this machine alone.

mod jobs;

#[cfg(unix)]
pub use jobs::stop;

use super::page::{Program, notes, with};
use super::{Failure, print};
use clap::{Args, value_parser};
use jobs::{Asked, Jobs, Seen};
use oxhttp::Server;
use oxhttp::model::header::{CACHE_CONTROL, CONTENT_TYPE, HOST, ORIGIN};
use oxhttp::model::{Body, HeaderMap, Method, Request, Response, StatusCode};
use std::hash::{BuildHasher, Hasher, RandomState};
use std::io::Read as _;
use std::net::{Ipv4Addr, TcpListener};
use std::sync::Arc;

/// Most bytes of a job that is posted.
const LARGEST: u64 = 64 << 20;

/// Most connections at once.
const CONNECTIONS: usize = 32;

/// Arguments of `serve`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Port on 127.0.0.1.
    #[arg(long, value_name = "PORT", default_value_t = 8017, value_parser = value_parser!(u16).range(1..))]
    port: u16,
}

pub fn serve(arguments: &Arguments) -> Result<(), Failure> {
    let port = arguments.port;
    let refuse = |error: std::io::Error| Failure::Argument {
        field: "--port",
        problem: format!("{port}: {error}"),
        allowed: "a port that is free".into(),
    };
    // The server would say nothing of it.
    drop(TcpListener::bind((Ipv4Addr::LOCALHOST, port)).map_err(refuse)?);
    // Other users of this machine do not know the path.
    let secret = format!("{:016x}", RandomState::new().build_hasher().finish());
    let site = Site {
        origin: format!("http://127.0.0.1:{port}"),
        host: format!("127.0.0.1:{port}"),
        page: format!("/{secret}/"),
        notes: format!("/{secret}/{}", notes::FILE),
        run: format!("/{secret}/run"),
        jobs: Jobs::new().map_err(refuse)?,
    };
    let address = format!("{}{}", site.origin, site.page);
    let site = Arc::new(site);
    let server = Server::new(move |request| site.answer(request))
        .bind((Ipv4Addr::LOCALHOST, port))
        .with_max_concurrent_connections(CONNECTIONS)
        .spawn()
        .map_err(refuse)?;
    print(&format!("{address}\nCtrl-C ends the server\n"))?;
    server.join().map_err(refuse)
}

/// The site: its addresses, and the jobs of its pages.
struct Site {
    origin: String,
    host: String,
    /// Path of the page.
    page: String,
    /// Path of its notes.
    notes: String,
    /// Path at which jobs are posted.
    run: String,
    jobs: Jobs,
}

impl Site {
    fn answer(&self, request: &mut Request<Body>) -> Response<Body> {
        if !self.is_own(request.headers()) {
            return plain(StatusCode::FORBIDDEN, "another site asks");
        }
        let path = request.uri().path().to_owned();
        let query = request.uri().query().unwrap_or_default().to_owned();
        if path == self.page && *request.method() == Method::GET {
            let page = with(Some(Program::Served(&self.run)), None);
            return answer("text/html; charset=utf-8", page.into_bytes());
        }
        if path == self.notes && *request.method() == Method::GET {
            return answer("application/json", notes::json().into_bytes());
        }
        let Some(rest) = path.strip_prefix(&self.run) else {
            return plain(StatusCode::NOT_FOUND, "there is nothing here");
        };
        let result = match (request.method(), rest.trim_start_matches('/')) {
            (&Method::POST, "") => self.begin(request.body_mut()),
            (&Method::GET, job) => match job.split_once('/') {
                None => self.jobs.look(job, seen(&query)).map(|state| json(&state)),
                Some((job, file)) => self
                    .jobs
                    .file(job, &decoded(file))
                    .map(|bytes| answer("application/octet-stream", bytes)),
            },
            (&Method::DELETE, job) => {
                self.jobs.end(job);
                Ok(plain(StatusCode::OK, ""))
            }
            _ => return plain(StatusCode::METHOD_NOT_ALLOWED, "GET, POST or DELETE"),
        };
        result.unwrap_or_else(|problem| plain(StatusCode::BAD_REQUEST, &problem))
    }

    /// True unless a page of another site asks, under whatever name it reaches this machine.
    fn is_own(&self, headers: &HeaderMap) -> bool {
        let is = |name, own: &str| headers.get(name).is_none_or(|value| value == own);
        headers.contains_key(HOST) && is(HOST, &self.host) && is(ORIGIN, &self.origin)
    }

    fn begin(&self, body: &mut Body) -> Result<Response<Body>, String> {
        let mut text = String::new();
        let read = body.take(LARGEST).read_to_string(&mut text);
        read.map_err(|error| error.to_string())?;
        let asked: Asked = serde_json::from_str(&text).map_err(|error| error.to_string())?;
        let id = self.jobs.begin(asked)?;
        Ok(json(&serde_json::json!({ "id": id })))
    }
}

/// Bytes that a page has seen, by the query of its address: `from=BYTE&series=BYTE`.
fn seen(query: &str) -> Seen {
    let value = |name| {
        let mut pairs = query.split('&').filter_map(|pair| pair.split_once('='));
        pairs.find(|pair| pair.0 == name)?.1.parse().ok()
    };
    Seen {
        said: value("from").unwrap_or(0),
        series: value("series"),
    }
}

/// Returns a path without `%` and two digits for a byte.
fn decoded(text: &str) -> String {
    let mut bytes = Vec::new();
    let mut rest = text.as_bytes();
    while let [first, after @ ..] = rest {
        let code = match (first, after) {
            (b'%', [high, low, ..]) => {
                u8::from_str_radix(&format!("{}{}", *high as char, *low as char), 16).ok()
            }
            _ => None,
        };
        bytes.push(code.unwrap_or(*first));
        rest = if code.is_some() { &after[2..] } else { after };
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

fn json(value: &impl serde::Serialize) -> Response<Body> {
    let text = serde_json::to_vec(value).unwrap_or_default();
    answer("application/json", text)
}

fn answer(kind: &'static str, bytes: Vec<u8>) -> Response<Body> {
    let mut response = Response::new(Body::from(bytes));
    let headers = response.headers_mut();
    headers.insert(CONTENT_TYPE, kind.parse().expect("a header"));
    headers.insert(CACHE_CONTROL, "no-store".parse().expect("a header"));
    response
}

fn plain(status: StatusCode, text: &str) -> Response<Body> {
    let mut response = answer("text/plain; charset=utf-8", text.as_bytes().to_vec());
    *response.status_mut() = status;
    response
}
